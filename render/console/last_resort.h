// How the program ends where it cannot go on, and an error that goes up to main() is no way out.
//
// From the first allocation by operator new that fails, in whatever thread, it ends at once: with 75, words
// that lie ready and ask for no memory, and without temporary files (render/files/temporaries.h). Nothing is
// unwound. On the way up are destructors that wait for other threads, functions that must not throw, and Mesa
// and LLVM, which were compiled without exceptions: they would be left with their locks held, and the end
// might never come. Pictures that are whole stay, as after a kill.
//
// Libraries in C say that there is no memory, and that is an error like others (75); or they do not look and
// crash, or abort: where there is no memory then, that is what the program says, with 75. A crash for another
// reason stays one.
//
// What reaches std::terminate (an exception in a thread of a library) ends with the code that it has anywhere
// else, and words.
#pragma once

namespace rend {

// From now on, for this whole program.
void arm_last_resort();

// Says that there is not enough memory, and ends with 75.
[[noreturn]] void end_without_memory() noexcept;

} // namespace rend
