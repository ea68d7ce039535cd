function reproductionReport() { runDetails(); }
