# What `cmake --install` puts where, in three components:
#   runtime      the program, the datasets and scenarios that come along, the documentation
#   development  libraries, headers and the CMake package for find_package(hoplab)
#   python       the module (python/CMakeLists.txt)
# The program needs none of the files beside it: published numbers and the reports' page are compiled in.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(share ${CMAKE_INSTALL_DATADIR}/hoplab)
install(TARGETS hoplab RUNTIME COMPONENT runtime)
install(DIRECTORY experiments/ DESTINATION ${share}/experiments COMPONENT runtime
        FILES_MATCHING PATTERN "*.yaml"
        PATTERN study EXCLUDE PATTERN kinematics EXCLUDE PATTERN identification EXCLUDE
        PATTERN published EXCLUDE PATTERN identified EXCLUDE PATTERN identified EXCLUDE)
install(PROGRAMS experiments/sweep.slurm DESTINATION ${share}/experiments COMPONENT runtime)
install(DIRECTORY datasets/ DESTINATION ${share}/datasets COMPONENT runtime
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.csv" PATTERN "*.json" PATTERN import EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT runtime)
# The plotting library is part of the program, and so is its licence.
get_directory_property(plotly DIRECTORY web DEFINITION plotly)
file(READ ${plotly}/LICENSE PLOTLY_LICENSE)
file(READ LICENSE HOPLAB_LICENSE)
configure_file(cmake/copyright.in ${PROJECT_BINARY_DIR}/copyright @ONLY)
# Debian's own changelog, which each of its packages must have; what changed stands in CHANGELOG.md.
set(HOPLAB_CONTACT "The hoplab authors <hoplab@hoplab.invalid>") # there is no address to write to
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/changelog CONTENT
"hoplab (${PROJECT_VERSION}) unstable; urgency=medium\n
  * See /usr/share/doc/hoplab/CHANGELOG.md.\n
 -- ${HOPLAB_CONTACT}  ${now}\n")
file(ARCHIVE_CREATE OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz PATHS ${PROJECT_BINARY_DIR}/changelog
     FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
# hoplab_package_documents(name component): what the Debian package `name` must have under share/doc.
function(hoplab_package_documents name component)
  install(FILES ${PROJECT_BINARY_DIR}/copyright ${PROJECT_BINARY_DIR}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endfunction()
hoplab_package_documents(hoplab runtime)
hoplab_package_documents(libhoplab-dev development)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
foreach(folder model datasets fitting experiments examples python bench web)
  install(FILES ${folder}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder}
          COMPONENT runtime)
endforeach()

# The libraries below the command line. A header is included as in the project:
# "fitting/fit_dataset.h".
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/hoplab)
set(cmake_files ${CMAKE_INSTALL_LIBDIR}/cmake/hoplab)
foreach(folder base model datasets fitting optimize experiments)
  set_target_properties(hoplab_${folder} PROPERTIES EXPORT_NAME ${folder})
  add_library(hoplab::${folder} ALIAS hoplab_${folder})
  install(TARGETS hoplab_${folder} EXPORT hoplab ARCHIVE COMPONENT development
          INCLUDES DESTINATION ${headers})
  install(DIRECTORY ${folder} DESTINATION ${headers} COMPONENT development
          FILES_MATCHING PATTERN "*.h"
          PATTERN rig-* EXCLUDE PATTERN robot-* EXCLUDE PATTERN published EXCLUDE
          PATTERN identified EXCLUDE REGEX "experiments/effects$" EXCLUDE
          # Readers of other programs' recordings serve the command alone.
          PATTERN import EXCLUDE PATTERN automata EXCLUDE)
endforeach()
install(DIRECTORY examples/ DESTINATION ${share}/examples COMPONENT development
        FILES_MATCHING PATTERN "*.cc" PATTERN "CMakeLists.txt" PATTERN "README.md")
install(EXPORT hoplab NAMESPACE hoplab:: FILE hoplabTargets.cmake DESTINATION ${cmake_files}
        COMPONENT development)

configure_package_config_file(cmake/hoplabConfig.cmake.in ${PROJECT_BINARY_DIR}/hoplabConfig.cmake
                              INSTALL_DESTINATION ${cmake_files})
# Before 1.0 a minor version may change what a program sees.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hoplabConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hoplabConfig.cmake
              ${PROJECT_BINARY_DIR}/hoplabConfigVersion.cmake
        DESTINATION ${cmake_files} COMPONENT development)

set_property(GLOBAL PROPERTY hoplab_components runtime development)
