#include "render/batch/batch_result.h"

#include "sim/base/enum_words.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>

namespace rend {
namespace {

// The first line of what it said went wrong; of one that was ended from outside, by what.
std::string message_of(const BatchResult& result, const std::string& err) {
  const std::string mark = "rend: error: ",
                    before = "\n" + mark; // a name may hold those words, but no line end
  const std::size_t last = err.rfind(before);
  const std::size_t at = last != std::string::npos ? last + 1 : err.starts_with(mark) ? 0 : last;
  if (at == std::string::npos) {
    if (result.ran && result.code == static_cast<int>(Exit::CheckFailed))
      return "an <answer> of the preset does not hold"; // its figures say which
    const int signal = result.code - 128;
    if (!result.ran || signal <= 0 || signal >= NSIG) return {};
    return fmt::format("it was killed by signal {} ({}), which this batch did not send", signal,
                       ::strsignal(signal));
  }
  const std::size_t begin = at + mark.size();
  return err.substr(begin, err.find('\n', begin) - begin);
}

} // namespace

const char* name_of(BatchState state) {
  static constexpr EnumWords<BatchState::Stopped> words{"done", "unstable", "failed", "stopped"};
  return words[state];
}

BatchState BatchResult::state() const {
  if (!ran) return BatchState::Stopped;
  if (code == static_cast<int>(Exit::Done)) return BatchState::Done;
  return code == static_cast<int>(Exit::Unstable) ? BatchState::Unstable : BatchState::Failed;
}

bool BatchResult::failed() const {
  return ran && code != static_cast<int>(Exit::Done);
}

void take_end(BatchResult& result, const Child& child, bool ran) {
  result.ran = ran;
  result.code = child.code();
  result.printed = child.out();
  result.log += child.err(); // of earlier tries, too
  result.figures = read_figures(result.printed);
  result.message = message_of(result, child.err());
}

} // namespace rend
