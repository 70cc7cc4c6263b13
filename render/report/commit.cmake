# Writes OUTPUT, a header that says which commit of SOURCE is being built; touches it only where that changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --dirty --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  set(commit "no commit")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// Which commit was built.
#pragma once

namespace rend {
inline constexpr const char* rend_commit = \"@commit@\";
} // namespace rend
")
