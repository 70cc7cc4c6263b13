// Reads what Rule::print() writes. Presets have their own reader; this one is for tests of the engine alone,
// and CHECKs where it meets anything else.
#pragma once

#include "sim/base/check.h"
#include "sim/rules/rule_settings.h"

#include <map>
#include <string>
#include <string_view>

namespace rend::rule_text {

class Reader {
public:
  explicit Reader(std::string_view text) : text_(text) {}

  RuleSettings run() {
    RuleSettings rule;
    const auto [name, open] = element();
    CHECK_NOTE(name == "rule", name);
    rule.name = value("name");
    rule.about = value("about");
    rule.left = value("left");
    rule.right = value("right");
    rule.may_fold = value("may-fold") == "yes";
    while (open) {
      const std::string part = element().first;
      if (part == "/rule") break;
      if (part == "where") rule.wheres.push_back({.name = value("name"), .value = value("value")});
      if (part == "let") rule.lets.push_back({.name = value("name"), .value = value("value")});
      if (part == "set")
        rule.sets.push_back({.node = value("node"),
                             .position = value("position"),
                             .rest = value("rest"),
                             .velocity = value("velocity")});
      if (part == "when") {
        using At = RuleWhenSettings::At;
        const std::string at = value("at");
        rule.whens.push_back({.test = value("test"),
                              .at = at == "all"   ? At::All
                                    : at == "any" ? At::Any
                                                  : At::Hook,
                              .otherwise = value("otherwise")});
      }
    }
    return rule;
  }

private:
  std::string take_until(std::string_view ends) {
    const std::size_t end = text_.find_first_of(ends, at_);
    CHECK_NOTE(end != std::string_view::npos, std::string(text_));
    const std::string taken(text_.substr(at_, end - at_));
    at_ = end;
    return taken;
  }

  // The name, and whether it holds others; its attributes go to values_.
  std::pair<std::string, bool> element() {
    values_.clear();
    take_until("<");
    ++at_;
    const bool closes = text_[at_] == '/';
    if (closes) ++at_;
    const std::string name = (closes ? "/" : "") + take_until(" />");
    while (text_[at_] == ' ') {
      ++at_;
      const std::string attribute = take_until("=");
      at_ += 2;
      values_[attribute] = plain(take_until("\""));
      ++at_;
    }
    return {name, text_[at_] == '>'};
  }

  std::string value(const std::string& attribute) const {
    const auto found = values_.find(attribute);
    return found == values_.end() ? std::string() : found->second;
  }

  static std::string plain(const std::string& escaped) {
    static const std::map<std::string, std::string> marks{
        {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}, {"&quot;", "\""}, {"&apos;", "'"}};
    std::string out;
    for (std::size_t n = 0; n < escaped.size(); ++n) {
      if (escaped[n] != '&') {
        out += escaped[n];
        continue;
      }
      const std::size_t end = escaped.find(';', n);
      out += marks.at(escaped.substr(n, end - n + 1));
      n = end;
    }
    return out;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::map<std::string, std::string> values_;
};

inline RuleSettings read(std::string_view text) {
  return Reader(text).run();
}

} // namespace rend::rule_text
