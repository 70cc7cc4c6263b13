#include "render/console/command_line.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <sstream>
#include <utility>

namespace rend {
namespace {

CLI::Validator validator_of(const WordCheck& check) {
  return {check.check, check.what};
}

OptionUsage option_usage(const CLI::Option& option) {
  OptionUsage out;
  for (const std::string& name : option.get_snames()) out.names.emplace_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.emplace_back("--" + name);
  if (out.names.empty()) out.names.push_back(option.get_name(true));
  const std::string type = option.get_type_name(); // "N:INT in [1 - 256]" for a validated number
  if (option.get_items_expected_max() > 0) out.value = type.substr(0, type.find(':'));
  out.what = option.get_description();
  out.fallback = option.get_default_str();
  out.required = option.get_required() || option.get_group() == required_by_command;
  out.repeated = option.get_expected_max() > 1;
  return out;
}

CommandUsage usage_of(const CLI::App& app) {
  CommandUsage out{app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  if (app.get_parent() != nullptr && app.get_parent()->get_footer() == out.footer) out.footer.clear();
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? out.positionals : out.options).push_back(option_usage(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    out.commands.push_back(usage_of(*command));
  return out;
}

// Pages of help as rend writes them, in place of CLI11's.
class Pages : public CLI::Formatter {
public:
  explicit Pages(ProgramLine::Page page) : page_(std::move(page)) {}
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    std::string name = app->get_name();
    for (const CLI::App* at = app->get_parent(); at != nullptr; at = at->get_parent())
      name = at->get_name() + " " + name;
    CommandUsage usage = usage_of(*app);
    usage.footer = app->get_footer();
    return page_(usage, name);
  }

private:
  ProgramLine::Page page_;
};

Refusal::Kind kind_of(const CLI::ParseError& error) {
  using enum Refusal::Kind;
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return UnknownWords;
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    return std::string(error.what()).starts_with("A subcommand") ? CommandMissing : ArgumentMissing;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return ValueMissing;
  return Other;
}

Refusal refusal_of(const CLI::App& app, const CLI::ParseError& error) {
  Refusal out{kind_of(error), error.what(), app.get_name(), {}, {}};
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) {
    at = at->get_subcommands().front();
    out.which += " " + at->get_name();
  }
  out.command = usage_of(*at);
  out.words = (out.kind == Refusal::Kind::CommandMissing ? at : &app)->remaining(true);
  return out;
}

} // namespace

Option Option::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}
Option Option::group(const std::string& name) const {
  option_->group(name);
  return *this;
}
Option Option::required(bool value) const {
  option_->required(value);
  return *this;
}
Option Option::check(const WordCheck& check) const {
  option_->check(validator_of(check));
  return *this;
}
Option Option::transform(const WordCheck& check) const {
  option_->transform(validator_of(check));
  return *this;
}
Option Option::one_of(const std::vector<std::string>& words) const {
  option_->check(CLI::IsMember(words));
  return *this;
}
Option Option::expected(int least, int most) const {
  option_->expected(least, most);
  return *this;
}
Option Option::allow_extra_args(bool value) const {
  option_->allow_extra_args(value);
  return *this;
}
Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}
Option Option::show_default() const {
  option_->capture_default_str();
  return *this;
}
Option Option::default_word(const std::string& word) const {
  option_->default_val(word);
  return *this;
}

template <class T>
Option CommandLine::add_option(const std::string& names, T& value, const std::string& what) const {
  return Option(app_->add_option(names, value, what));
}
template Option CommandLine::add_option(const std::string&, std::string&, const std::string&) const;
template Option CommandLine::add_option(const std::string&, std::vector<std::string>&,
                                        const std::string&) const;
template Option CommandLine::add_option(const std::string&, int&, const std::string&) const;
template Option CommandLine::add_option(const std::string&, long&, const std::string&) const;
template Option CommandLine::add_option(const std::string&, double&, const std::string&) const;
template Option CommandLine::add_option(const std::string&, std::optional<long>&, const std::string&) const;
template Option CommandLine::add_option(const std::string&, std::optional<double>&, const std::string&) const;

Option CommandLine::add_flag(const std::string& names, bool& value, const std::string& what) const {
  return Option(app_->add_flag(names, value, what));
}
Option CommandLine::option(const std::string& name) const {
  return Option(app_->get_option(name));
}
CommandLine CommandLine::add_command(const std::string& name, const std::string& what) const {
  return CommandLine(app_->add_subcommand(name, what));
}
void CommandLine::require_command() const {
  app_->require_subcommand(1);
}
void CommandLine::on_parsed(std::function<void()> run) const {
  app_->callback(std::move(run));
}
void CommandLine::footer(const std::string& text) const {
  app_->footer(text);
}
CommandLine CommandLine::parent() const {
  return CommandLine(app_->get_parent());
}
CommandLine CommandLine::command(const std::string& name) const {
  return CommandLine(app_->get_subcommand(name));
}
CommandUsage CommandLine::usage() const {
  return usage_of(*app_);
}
// App::help would print the page of the subcommand that was parsed.
std::string CommandLine::page() const {
  return app_->get_formatter()->make_help(app_, app_->get_name(), CLI::AppFormatMode::Normal);
}

ProgramLine::ProgramLine(const std::string& name, const std::string& what, std::function<std::string()> version,
                         const Page& page)
    : app_(std::make_unique<CLI::App>(what, name)) {
  app_->set_version_flag("--version", std::move(version),
                         "print the version, the commit and the versions of libraries");
  app_->set_help_flag("-h,--help", "print this help");
  app_->formatter(std::make_shared<Pages>(page));
}
ProgramLine::~ProgramLine() = default;

std::string ProgramLine::parse(int count, const char* const* arguments) const {
  try {
    app_->parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    if (app_->exit(error, out, err) == 0) return out.str();
    throw refusal_of(*app_, error);
  }
  return {};
}

} // namespace rend
