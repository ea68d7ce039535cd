#include "app/runs/report_settings.h"

namespace hoplab {

void AddReportOptions(CLI::App& sub, ReportSettings& settings) {
  sub.add_option(
         "RUN_DIR", settings.folders,
         "A folder with run.json and its tables; two or more fits or diagnoses are compared "
         "with the first")
      ->required();
  AddRunFolderOptions(sub, settings, "Folder of a comparison (default runs/<run>-comparison-NNN)");
}

}  // namespace hoplab
