# Writes OUTPUT, a header with the current commit of SOURCE; rewrites it only when that has changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --dirty --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  set(commit "no commit")
endif()
execute_process(COMMAND git -C ${SOURCE} log -1 --format=%cs
                OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// Which commit was built.
#pragma once

namespace rend {
inline constexpr const char* rend_commit = \"@commit@\";
inline constexpr const char* rend_commit_date = \"@date@\";
} // namespace rend
")
