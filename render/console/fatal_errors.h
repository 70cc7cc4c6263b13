// How the program ends where it cannot continue, and unwinding to main() is not possible.
//
// From the first allocation by operator new that fails, in whatever thread, it ends at once: with 75, words
// that lie ready and ask for no memory, and without temporary files (render/files/temporaries.h). Nothing is
// unwound. On the way up are destructors that wait for other threads, functions that must not throw, and Mesa
// and LLVM, which were compiled without exceptions: they would be left with their locks held, and the end
// might never come. Pictures that are whole stay, as after a kill.
//
// A C library either reports a failed allocation, which is an error like others (75), or does not check, and
// crashes or aborts: if no memory is left at that moment, the program reports that, with 75. Other crashes stay
// crashes.
//
// An exception that reaches std::terminate (in a library's thread) gives its usual exit code and message.
#pragma once

namespace rend {

// Installs the handlers, for the whole process.
void install_fatal_error_handlers();

// Prints that there is not enough memory, and exits with 75.
[[noreturn]] void end_without_memory() noexcept;

} // namespace rend
