#pragma once
// Errors that the program reports to the user, each class with an exit code.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace dmoscope {

/// Base of all errors that are meant for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// Exit code of the program: 1 not reached, 2 wrong usage, 3 bad input or output.
  [[nodiscard]] virtual int exit_code() const noexcept { return 3; }
};

/// Wrong content of a file. what() is "file:line: reason" (line 0: "file: reason").
class InputError : public Error {
 public:
  InputError(std::string file, std::size_t line, const std::string& what)
      : Error(line == 0 ? file + ": " + what : file + ":" + std::to_string(line) + ": " + what), file_(std::move(file)), line_(line) {}
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// Line number from 1; 0 if lines make no sense (binary data, missing file).
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  std::string file_;
  std::size_t line_;
};

/// Failure to write a file; the old one, if any, is unchanged. what() is "file: reason".
class OutputError : public Error {
 public:
  OutputError(const std::string& file, const std::string& what) : Error(file + ": " + what) {}
};

/// Request for something that does not exist or does not fit (unknown metric, bad parameter).
class UsageError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] int exit_code() const noexcept override { return 2; }
};

/// Failure of a device (GPU), or lack of a resource such as memory. what() names it and, for memory, the requested and the free amount.
class DeviceError : public Error {
 public:
  using Error::Error;
};

/// Work that ended without reaching its aim (not converged, expectation failed).
class NotReached : public Error {
 public:
  using Error::Error;
  [[nodiscard]] int exit_code() const noexcept override { return 1; }
};

/// Cancelled long work: its unfinished result is discarded, and the former state is unchanged.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
  [[nodiscard]] int exit_code() const noexcept override { return 1; }
};

}  // namespace dmoscope
