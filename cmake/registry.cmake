# hoplab_registry(type namespace folder registry files): one file, one entry. From `folder`/registry.cc.in
# writes the file `registry`, which knows the variable of every .cc in `folder` (named as its file, of
# the type and in the namespace given), and the list of those files to the variable `files`.
function(hoplab_registry type namespace folder registry files)
  file(GLOB entry_files CONFIGURE_DEPENDS ${folder}/*.cc)
  list(FILTER entry_files EXCLUDE REGEX "/effect[.]cc$")  # what every effect shares
  list(SORT entry_files)
  set(HOPLAB_DECLARATIONS "")
  set(addresses "")
  foreach(file IN LISTS entry_files)
    get_filename_component(name ${file} NAME_WE)
    string(APPEND HOPLAB_DECLARATIONS "extern const ${type} ${name};\n")
    list(APPEND addresses "&${namespace}::${name}")
  endforeach()
  list(JOIN addresses ", " HOPLAB_ADDRESSES)
  configure_file(${folder}/registry.cc.in ${registry} @ONLY)
  set(${files} ${entry_files} PARENT_SCOPE)
endfunction()

# hoplab_effect_registry(folder registry files): the same for effects.
function(hoplab_effect_registry folder registry files)
  hoplab_registry(Effect effects ${folder} ${registry} found)
  set(${files} ${found} PARENT_SCOPE)
endfunction()
