# Debian packages: `cpack` in the build folder. One for each component of install.cmake.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hoplab)
set(CPACK_PACKAGE_VENDOR "hoplab")
set(CPACK_PACKAGE_CONTACT ${HOPLAB_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "workbench for hoppers with compliant legs")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # Depends: what the program is linked to
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME hoplab)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS openmpi-bin) # mpirun, and the library the program then opens
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"Fits Young's modulus, damping and start states of a compliant leg to recorded
hops through a differentiable hybrid simulator, says what the simulation lacks,
finds gaits and gains, sweeps, and shows it all in reports that open offline.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhoplab-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libboost-dev, libceres-dev, libeigen3-dev, libfmt-dev, libnlopt-cxx-dev, libnlopt-dev, libsundials-dev, libyaml-cpp-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, hoplab")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Libraries and headers of hoplab, for C++ programs that simulate, fit and
diagnose hoppers with compliant legs: find_package(hoplab).")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hoplab)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(TARGET hoplab_python)
  # The compiled part is for one minor version of the interpreter.
  get_directory_property(python_minor DIRECTORY python DEFINITION Python_VERSION_MINOR)
  math(EXPR next_python "${python_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${python_minor}~), python3 (<< 3.${next_python}), python3-numpy")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"Python module of hoplab: simulates, fits and diagnoses hoppers with compliant
legs, with exact sensitivities, as NumPy arrays.")

get_property(CPACK_COMPONENTS_ALL GLOBAL PROPERTY hoplab_components)
include(CPack)
