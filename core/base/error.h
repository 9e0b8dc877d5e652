#pragma once
// Every error the program reports to a person. Each class says which exit code it maps to.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace dmoscope {

/// Base of all errors that are meant to be read by a person.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// Exit code of the program: 1 not reached, 2 wrong usage, 3 bad input or output.
  [[nodiscard]] virtual int exit_code() const noexcept { return 3; }
};

/// A file's content is wrong. what() is "file:line: what is wrong" (line 0: "file: what is wrong").
class InputError : public Error {
 public:
  InputError(std::string file, std::size_t line, const std::string& what)
      : Error(line == 0 ? file + ": " + what : file + ":" + std::to_string(line) + ": " + what), file_(std::move(file)), line_(line) {}
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// 1-based line, 0 where a line makes no sense (binary data, missing file).
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  std::string file_;
  std::size_t line_;
};

/// A file could not be written; the old one, if any, is untouched. what() is "file: why".
class OutputError : public Error {
 public:
  OutputError(const std::string& file, const std::string& what) : Error(file + ": " + what) {}
};

/// The caller asked for something that does not exist or does not fit (unknown metric, bad parameter).
class UsageError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] int exit_code() const noexcept override { return 2; }
};

/// A device (GPU) failed or lacks what was asked of it, such as memory. what() says what failed and, for memory, how much was asked for and
/// how much is free.
class DeviceError : public Error {
 public:
  using Error::Error;
};

/// The work was done but what was asked for was not reached (not converged, expectation failed).
class NotReached : public Error {
 public:
  using Error::Error;
  [[nodiscard]] int exit_code() const noexcept override { return 1; }
};

/// The person cancelled long work: what was being built is discarded, and what was there before is unchanged.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
  [[nodiscard]] int exit_code() const noexcept override { return 1; }
};

}  // namespace dmoscope
