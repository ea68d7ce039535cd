#pragma once

namespace hoplab {

/// What the program was built to use that the processor it runs on does not have; null where it has
/// all (cmake/processor.cmake).
const char* MissingOfProcessor();

}  // namespace hoplab
