// Where the tests find the sources, and what was built beside them. They are data of one file, not macros on
// the command line of each: else no two trees would share a compiled test (ccache).
#pragma once

namespace rend::test {

// Absolute paths; constant-initialised, so that other constants may be made of them.
extern const char* const source_root;             // of the source tree
extern const char* const rend_program;            // the built program
extern const char* const watch_disk_library;      // for LD_PRELOAD: logs fsync and rename
extern const char* const failing_threads_library; // for LD_PRELOAD: refuses to start threads

} // namespace rend::test
