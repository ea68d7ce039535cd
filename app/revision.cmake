# Run at each build: writes app/revision.h where what git says has changed. A source tree without
# git (a tarball) gives an empty revision, not an error.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --tags --always --dirty
                OUTPUT_VARIABLE revision ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${SOURCE_DIR}/.git)
  set(revision "")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define HOPLAB_REVISION \"${revision}\"\n")
