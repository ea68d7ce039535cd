# cmake -D OUTPUT=assets.cc -D FILES=name=path,... -P embed.cmake: the files as a C++ source that
# defines WebAsset (web/assets.h), or the FUNCTION of the HEADER.
if(NOT DEFINED FUNCTION)
  set(FUNCTION WebAsset)
  set(HEADER web/assets.h)
endif()
string(REPLACE "," ";" FILES "${FILES}")
set(texts "")
set(cases "")
set(number 0)
foreach(entry IN LISTS FILES)
  string(REGEX MATCH "^([^=]+)=(.+)$" matched "${entry}")
  set(name ${CMAKE_MATCH_1})
  file(READ ${CMAKE_MATCH_2} content)
  string(FIND "${content}" ")~hoplab~\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${name} holds the mark that ends a text")
  endif()
  string(APPEND texts "constexpr char k${FUNCTION}${number}[] = R\"~hoplab~(${content})~hoplab~\";\n")
  string(APPEND cases
    "  if (name == \"${name}\") return {k${FUNCTION}${number}, sizeof k${FUNCTION}${number} - 1};\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Written by cmake; do not edit.
#include \"${HEADER}\"

#include \"base/check.h\"

namespace hoplab {
namespace {

${texts}
}  // namespace

std::string_view ${FUNCTION}(std::string_view name) {
${cases}  HOPLAB_CHECK(false && \"no such asset\");
  return {};
}

}  // namespace hoplab
")
