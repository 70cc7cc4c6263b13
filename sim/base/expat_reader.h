// What readers of XML have in common. Exceptions must not pass through expat, which is C: what a handler throws
// is kept until expat has returned.
//
//   class Reader : ExpatReader<Reader> sets handlers on parser_, with itself as user data, and does in each of
//   them what it does within guard().
#pragma once

#include <expat.h>

#include <cstddef>
#include <exception>
#include <new>
#include <string_view>

namespace rend {

// expat detects UTF-16 by its first bytes, whatever encoding it is given; the raw text would then differ from
// what expat parses.
inline bool is_utf16(std::string_view text) {
  const bool marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  return marked || text.substr(0, 2).find('\0') != std::string_view::npos;
}

template <class Reader> class ExpatReader {
public:
  ExpatReader(const ExpatReader&) = delete;
  ExpatReader& operator=(const ExpatReader&) = delete;

protected:
  // `encoding`: null: the one that the text names, or UTF-8.
  explicit ExpatReader(const char* encoding) : parser_(XML_ParserCreate(encoding)) {
    if (!parser_) throw std::bad_alloc();
  }
  ~ExpatReader() { XML_ParserFree(parser_); }

  // Calls handler(reader).
  template <class Handler> void guard(const Handler& handler) {
    if (failure_) return; // expat may still report the end of an empty element after it was stopped
    try {
      handler(static_cast<Reader&>(*this));
    } catch (...) {
      failure_ = std::current_exception();
      XML_StopParser(parser_, XML_FALSE);
    }
  }

  std::size_t here() const { // [bytes], of what is being read
    const XML_Index index = XML_GetCurrentByteIndex(parser_);
    return index < 0 ? 0 : static_cast<std::size_t>(index);
  }

  // Of at most INT_MAX bytes. False: they are not XML. Throws what a handler has thrown.
  bool parse(std::string_view text) {
    const XML_Status status = XML_Parse(parser_, text.data(), static_cast<int>(text.size()), XML_TRUE);
    if (failure_) std::rethrow_exception(failure_);
    return status == XML_STATUS_OK;
  }

  XML_Parser parser_;

private:
  std::exception_ptr failure_;
};

} // namespace rend
