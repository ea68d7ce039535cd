# Flags every target of the project shares.
add_library(hoplab_settings INTERFACE)
target_include_directories(hoplab_settings INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
target_compile_options(hoplab_settings INTERFACE -Wall -Wextra -Wpedantic -Werror -Wno-psabi
                       # Settings structs are filled by name; the rest keep their defaults.
                       -Wno-missing-field-initializers)
# A failed check names its file within the project, wherever that was built.
target_compile_options(hoplab_settings INTERFACE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports false positives inside Eigen and std::string at -O3.
  target_compile_options(hoplab_settings INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds
                                                   -Wno-stringop-overread -Wno-restrict)
  # Nobody puts other functions in place of ours at load time: position-independent code may inline
  # them as a program's own code does.
  target_compile_options(hoplab_settings INTERFACE -fno-semantic-interposition)
  # The compiler collects its garbage once it holds a gigabyte, not 128 MB: a source takes 5 to 12 %
  # less of the processor, and the largest one 2.8 GB, not 2.3.
  target_compile_options(hoplab_settings INTERFACE --param=ggc-min-heapsize=1000000)
endif()
if(HOPLAB_SANITIZE)
  target_compile_options(hoplab_settings INTERFACE -fsanitize=address,undefined
                                                   -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(hoplab_settings INTERFACE -fsanitize=address,undefined)
endif()
if(HOPLAB_FUZZ)
  # The fuzzer watches the branches of every target; only its own programs have libFuzzer's main.
  target_compile_options(hoplab_settings INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                                                   -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(hoplab_settings INTERFACE -fsanitize=address,undefined)
endif()
