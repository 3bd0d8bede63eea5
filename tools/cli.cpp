#include "tools/cli.h"

#include <fcntl.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

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

namespace tools {
namespace {

/// A word that a POSIX shell reads as it is.
std::string quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Goes through the arguments, sets what options set, and gathers the operands.
class ArgumentReader {
 public:
  ArgumentReader(CommandLine& options, const std::vector<std::string>& arguments)
      : options_(options), arguments_(arguments) {}

  std::vector<std::string> read(std::size_t least, std::size_t most);

 private:
  using Entry = OptionEntry;
  Entry& find(const std::string& written) const;
  static void apply(Entry& entry, const std::string& written, const std::string& value);
  void read_long();
  void read_short();
  void read_value(Entry& entry, const std::string& written);
  void check_complete(std::size_t least, std::size_t most) const;

  CommandLine& options_;
  const std::vector<std::string>& arguments_;
  std::size_t at_ = 0;  ///< the argument in hand
  std::vector<std::string> operands_;
};

std::vector<std::string> ArgumentReader::read(std::size_t least, std::size_t most) {
  bool options_ended = false;
  for (; at_ < arguments_.size(); ++at_) {
    const std::string& argument = arguments_[at_];
    if (options_ended || argument.size() < 2 || argument[0] != '-')
      operands_.push_back(argument);
    else if (argument == "--")
      options_ended = true;
    else if (argument[1] == '-')
      read_long();
    else
      read_short();
  }
  check_complete(least, most);
  return std::move(operands_);
}

ArgumentReader::Entry& ArgumentReader::find(const std::string& written) const {
  for (Entry& entry : options_.entries()) {
    const Option& option = entry.option;
    if (option.letter && written == std::string{'-', option.letter}) return entry;
    if (option.name.empty()) continue;
    if (written == "--" + option.name) return entry;
    if (entry.takes == Takes::yes_or_no && written == "--no-" + option.name) return entry;
  }
  throw UsageError("unknown option " + written);
}

void ArgumentReader::apply(Entry& entry, const std::string& written, const std::string& value) {
  entry.given = true;
  try {
    entry.assign(value);
  } catch (const geom::InputError& error) {
    throw geom::InputError(written + ": " + error.what());
  }
}

/// --name, --name=value or --name value.
void ArgumentReader::read_long() {
  const std::string& argument = arguments_[at_];
  const std::size_t equals = argument.find('=');
  const bool has_value = equals != std::string::npos;
  const std::string written = argument.substr(0, equals);
  Entry& entry = find(written);
  if (entry.takes == Takes::nothing || entry.takes == Takes::yes_or_no) {
    if (has_value) throw UsageError(written + " takes no value");
    apply(entry, written, written == "--" + entry.option.name ? "yes" : "no");
  } else if (has_value) {
    apply(entry, written, argument.substr(equals + 1));
  } else if (entry.takes == Takes::maybe_value) {
    apply(entry, written, "");
  } else {
    read_value(entry, written);
  }
}

/// -n value, -nvalue or the flag -q.
void ArgumentReader::read_short() {
  const std::string& argument = arguments_[at_];
  const std::string written = argument.substr(0, 2);
  Entry& entry = find(written);
  if (entry.takes != Takes::value) {
    if (argument.size() > 2) throw UsageError("unknown option " + argument);
    apply(entry, written, "yes");
  } else if (argument.size() > 2) {
    apply(entry, written, argument.substr(2));
  } else {
    read_value(entry, written);
  }
}

/// The argument after the one in hand, which then is in hand.
void ArgumentReader::read_value(Entry& entry, const std::string& written) {
  if (at_ + 1 == arguments_.size())
    throw UsageError(written + " " + entry.option.value + ": the value is missing");
  apply(entry, written, arguments_[++at_]);
}

void ArgumentReader::check_complete(std::size_t least, std::size_t most) const {
  if (operands_.size() < least) throw UsageError(options_.operands() + " is missing");
  if (operands_.size() > most) throw UsageError("unexpected argument '" + operands_[most] + "'");
  for (const Entry& entry : options_.entries()) {
    const Option& option = entry.option;
    if (!option.required || entry.given) continue;
    const std::string written = option.letter ? std::string{'-', option.letter} : "--" + option.name;
    throw UsageError(written + " " + option.value + " is missing");
  }
}

}  // namespace

CommandLine::CommandLine(std::string program, std::vector<std::string> arguments)
    : Usage(std::move(program)),
      arguments_(std::move(arguments)),
      threads_(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

std::string CommandLine::command() const {
  std::string text = program();
  for (const std::string& argument : arguments_) text += " " + quoted(argument);
  return text;
}

void CommandLine::declare_common() {
  group("Common");
  integer({.name = "seed", .value = "S", .help = "same input and seed, same result"}, seed_, 0, UINT64_MAX);
  integer({.name = "threads", .value = "T", .help = "threads at most", .standard = "all cores"}, threads_, 1,
          1024);
  flag({.name = "quiet", .help = "no progress line"}, quiet_);
  request({.name = "help", .letter = 'h', .help = "this text"}, [this] {
    std::cout << help(entries());
    throw Finished{};
  });
  request({.name = "version", .help = "name and version"}, [this] {
    std::cout << program() << " " FPO_VERSION "\n";
    throw Finished{};
  });
}

std::vector<std::string> CommandLine::parse(std::size_t least, std::size_t most) {
  declare_common();
  return ArgumentReader(*this, arguments_).read(least, most);
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

/// Large arrays go back to the system when they are freed. By itself glibc stops that once such have been
/// freed: a run of 300,000 samples takes a quarter more then, in gaps between what is still used.
void give_large_arrays_back() {
#ifdef __GLIBC__
  constexpr int large = 4 << 20;
  mallopt(M_MMAP_THRESHOLD, large);
#endif
}

}  // namespace

int run(const std::string& program, int argc, const char* const* argv,
        const std::function<int(CommandLine&)>& tool) {
  occupy_standard_streams();
  give_large_arrays_back();
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
