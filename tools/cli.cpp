#include "tools/cli.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>
#include <thread>

#include "geom/exact/expansion.h"
#include "io/extension.h"

namespace tools {
namespace {

std::string with_default(const std::string& given, const Option& option, const std::string& initial) {
  return given.empty() && !option.required ? initial : given;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : separator) + word;
  return joined;
}

/// "-n, --count COUNT": every way to write an option, as the help shows it.
std::string forms(const Option& option, bool negatable, bool maybe_value) {
  std::string text = option.letter ? std::string{'-', option.letter} : "   ";
  if (!option.name.empty()) {
    text += option.letter ? ", --" : " --";
    text += (negatable ? "[no-]" : "") + option.name;
  }
  if (maybe_value) return text + "[=" + option.value + "]";
  return text + (option.value.empty() ? "" : " " + option.value);
}

/// A word that a POSIX shell reads as it is.
std::string quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Breaks a text between words into lines of at most `width` characters, each but the first indented.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string result;
  std::size_t column = 0, begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column > 0 && column + 1 + (end - begin) > width) {
      result += "\n" + std::string(indent, ' ');
      column = 0;
    }
    if (column > 0) result += ' ', ++column;
    result.append(text, begin, end - begin);
    column += end - begin;
    begin = end + 1;
  }
  return result;
}

}  // namespace

CommandLine::CommandLine(std::string program, std::vector<std::string> arguments)
    : program_(std::move(program)),
      arguments_(std::move(arguments)),
      threads_(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

std::string CommandLine::command() const {
  std::string text = program_;
  for (const std::string& argument : arguments_) text += " " + quoted(argument);
  return text;
}

void CommandLine::describe(std::string operands, std::string summary) {
  operands_ = std::move(operands);
  summary_ = std::move(summary);
}

void CommandLine::example(std::string arguments, std::string what) {
  examples_.emplace_back(std::move(arguments), std::move(what));
}

void CommandLine::group(std::string title) { group_ = std::move(title); }

void CommandLine::declare(Option option, Kind kind, Assign assign) {
  entries_.push_back({std::move(option), kind, std::move(assign), group_});
}

void CommandLine::custom(Option option, Assign assign) {
  declare(std::move(option), Kind::with_value, std::move(assign));
}

void CommandLine::custom_or_none(Option option, Assign assign) {
  declare(std::move(option), Kind::maybe_value, std::move(assign));
}

void CommandLine::number(Option option, double& target, double low, double high) {
  option.standard = with_default(option.standard, option, shortest(target));
  custom(std::move(option),
         [&target, low, high](const std::string& text) { target = parse_number(text, low, high); });
}

void CommandLine::text(Option option, std::string& target) {
  option.standard = with_default(option.standard, option, target);
  custom(std::move(option), [&target](const std::string& text) { target = text; });
}

void CommandLine::path(Option option, std::filesystem::path& target) {
  option.standard = with_default(option.standard, option, target.string());
  custom(std::move(option), [&target](const std::string& text) {
    geom::require(!text.empty(), "a file name cannot be empty");
    target = text;
  });
}

void CommandLine::output(Option option, std::filesystem::path& target, std::vector<std::string> endings) {
  custom(std::move(option), [&target, endings = std::move(endings)](const std::string& text) {
    geom::require(!text.empty(), "a file name cannot be empty");
    io::require_extension(text, endings);
    target = text;
  });
}

void CommandLine::flag(Option option, bool& target) {
  declare(std::move(option), Kind::flag, [&target](const std::string&) { target = true; });
}

void CommandLine::toggle(Option option, bool& target) {
  option.standard = with_default(option.standard, option, target ? "on" : "off");
  declare(std::move(option), Kind::toggle, [&target](const std::string& text) { target = text == "yes"; });
}

void CommandLine::toggle(Option option, std::optional<bool>& target) {
  declare(std::move(option), Kind::toggle, [&target](const std::string& text) { target = text == "yes"; });
}

void CommandLine::toggle(Option option, std::function<void(bool)> assign) {
  declare(std::move(option), Kind::toggle,
          [assign = std::move(assign)](const std::string& text) { assign(text == "yes"); });
}

void CommandLine::declare_choice(Option option, std::vector<std::string> words,
                                 std::function<void(std::size_t)> assign) {
  custom(std::move(option), [words = std::move(words), assign = std::move(assign)](const std::string& text) {
    const auto word = std::find(words.begin(), words.end(), text);
    geom::require(word != words.end(), "'" + text + "' is none of " + join(words, ", "));
    assign(static_cast<std::size_t>(word - words.begin()));
  });
}

void CommandLine::declare_common() {
  group("Common");
  integer({.name = "seed", .value = "S", .help = "same input and seed, same result"}, seed_, 0, UINT64_MAX);
  integer({.name = "threads", .value = "T", .help = "threads at most", .standard = "all cores"}, threads_, 1,
          1024);
  flag({.name = "quiet", .help = "no progress line"}, quiet_);
  declare({.name = "help", .letter = 'h', .help = "this text"}, Kind::flag, [this](const std::string&) {
    std::cout << help();
    throw Finished{};
  });
  declare({.name = "version", .help = "name and version"}, Kind::flag, [this](const std::string&) {
    std::cout << program_ << " " FPO_VERSION "\n";
    throw Finished{};
  });
}

std::vector<std::string> CommandLine::parse(std::size_t least, std::size_t most) {
  declare_common();
  std::vector<std::string> operands;
  bool options_ended = false;
  for (std::size_t i = 0; i < arguments_.size();) {
    const std::string& argument = arguments_[i];
    if (options_ended || argument.size() < 2 || argument[0] != '-') {
      operands.push_back(argument);
      ++i;
    } else if (argument == "--") {
      options_ended = true;
      ++i;
    } else {
      i = argument[1] == '-' ? read_long(i) : read_short(i);
    }
  }
  check_complete(operands, least, most);
  return operands;
}

CommandLine::Entry& CommandLine::find(const std::string& written) {
  for (Entry& entry : entries_) {
    const Option& option = entry.option;
    if (option.letter && written == std::string{'-', option.letter}) return entry;
    if (option.name.empty()) continue;
    if (written == "--" + option.name) return entry;
    if (entry.kind == Kind::toggle && written == "--no-" + option.name) return entry;
  }
  throw UsageError("unknown option " + written);
}

void CommandLine::apply(Entry& entry, const std::string& written, const std::string& value) {
  entry.given = true;
  try {
    entry.assign(value);
  } catch (const geom::InputError& error) {
    throw geom::InputError(written + ": " + error.what());
  }
}

/// Reads --name, --name=value or --name value at argument i; returns where the next argument stands.
std::size_t CommandLine::read_long(std::size_t i) {
  const std::string& argument = arguments_[i];
  const std::size_t equals = argument.find('=');
  const std::string written = argument.substr(0, equals);
  Entry& entry = find(written);
  if (entry.kind == Kind::maybe_value && equals == std::string::npos) {
    apply(entry, written, "");
    return i + 1;
  }
  if (entry.kind != Kind::with_value && entry.kind != Kind::maybe_value) {
    if (equals != std::string::npos) throw UsageError(written + " takes no value");
    apply(entry, written, written == "--" + entry.option.name ? "yes" : "no");
    return i + 1;
  }
  if (equals != std::string::npos) {
    apply(entry, written, argument.substr(equals + 1));
    return i + 1;
  }
  return read_next(entry, written, i);
}

/// Reads -n value, -nvalue or the flag -q at argument i; returns where the next argument stands.
std::size_t CommandLine::read_short(std::size_t i) {
  const std::string& argument = arguments_[i];
  const std::string written = argument.substr(0, 2);
  Entry& entry = find(written);
  if (entry.kind != Kind::with_value) {
    if (argument.size() > 2) throw UsageError("unknown option " + argument);
    apply(entry, written, "yes");
    return i + 1;
  }
  if (argument.size() > 2) {
    apply(entry, written, argument.substr(2));
    return i + 1;
  }
  return read_next(entry, written, i);
}

std::size_t CommandLine::read_next(Entry& entry, const std::string& written, std::size_t i) {
  if (i + 1 == arguments_.size())
    throw UsageError(written + " " + entry.option.value + ": the value is missing");
  apply(entry, written, arguments_[i + 1]);
  return i + 2;
}

void CommandLine::check_complete(const std::vector<std::string>& operands, std::size_t least,
                                 std::size_t most) const {
  if (operands.size() < least) throw UsageError(operands_ + " is missing");
  if (operands.size() > most) throw UsageError("unexpected argument '" + operands[most] + "'");
  for (const Entry& entry : entries_) {
    const Option& option = entry.option;
    if (!option.required || entry.given) continue;
    const std::string written = option.letter ? std::string{'-', option.letter} : "--" + option.name;
    throw UsageError(written + " " + option.value + " is missing");
  }
}

namespace {

constexpr std::size_t page_width = 79, help_column = 27;

/// An option and what it does: beside it, or below if it is long.
std::string entry_text(const Option& option, const std::string& forms) {
  std::string phrase = option.help;
  if (option.required) phrase += " (required)";
  if (!option.standard.empty()) phrase += " (default " + option.standard + ")";
  std::string line = "  " + forms;
  if (line.size() + 2 > help_column) line += "\n" + std::string(help_column, ' ');
  if (line.size() < help_column) line.resize(help_column, ' ');
  return line + wrapped(phrase, help_column, page_width - help_column) + "\n";
}

}  // namespace

std::string CommandLine::help() const {
  std::string text = "Usage: " + program_ + (operands_.empty() ? "" : " " + operands_) + " [options]\n";
  text += wrapped(summary_, 0, page_width) + "\n";
  if (!examples_.empty()) text += "\nExamples\n";
  for (const auto& [arguments, what] : examples_)
    text += "  " + program_ + " " + arguments + "\n      " + wrapped(what, 6, page_width - 6) + "\n";
  std::vector<std::string> groups;
  for (const Entry& entry : entries_)
    if (std::ranges::find(groups, entry.group) == groups.end()) groups.push_back(entry.group);
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& g) { return !g.starts_with("Expert"); });
  for (const std::string& group : groups) {
    text += "\n" + group + "\n";
    for (const Entry& entry : entries_)
      if (entry.group == group)
        text += entry_text(entry.option,
                           forms(entry.option, entry.kind == Kind::toggle, entry.kind == Kind::maybe_value));
  }
  return text;
}

namespace {

/// Were a standard stream closed, the first file to be opened would take its place and get its text. Now
/// writing to a closed stdout still fails.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) {
      const int opened = ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
      if (opened >= 0 && opened != stream) ::close(opened);
    }
}

/// Everything on stdout must have arrived before a tool may say that it is done.
void flush_results() {
  errno = 0;
  if (!std::cout.flush() || std::fflush(stdout) != 0) {
    const int reason = errno;
    throw geom::InputError(std::string("standard output: ") +
                           (reason ? std::strerror(reason) : "write error"));
  }
}

int complain(const std::string& program, const std::string& message, int code) {
  std::cerr << program << ": " << message << std::endl;
  return code;
}

int run_tool(CommandLine& cli, const std::function<int(CommandLine&)>& tool) {
  try {
    const int code = tool(cli);
    flush_results();
    return code;
  } catch (const Finished&) {
    flush_results();
    return exit_done;
  }
}

}  // namespace

int run(const std::string& program, int argc, const char* const* argv,
        const std::function<int(CommandLine&)>& tool) {
  occupy_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  CommandLine cli(program, std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
  try {
    geom::self_test();
    return run_tool(cli, tool);
  } catch (const geom::Interrupted& end) {
    return complain(program, std::string(end.what()) + ": nothing is written", exit_interrupted);
  } catch (const UsageError& error) {
    return complain(program, std::string(error.what()) + " (see " + program + " --help)", exit_bad_input);
  } catch (const geom::InputError& error) {
    return complain(program, error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain(program, "out of memory: the input or the number asked for is too large", exit_bad_input);
  } catch (const std::system_error& error) {  // a folder that has gone, no thread to be had
    return complain(program, error.what(), exit_bad_input);
  } catch (const std::exception& error) {
    const std::string seed = " (seed " + std::to_string(cli.seed()) + ")";
    return complain(program, std::string("internal error: ") + error.what() + seed, exit_bug);
  }
}

}  // namespace tools
