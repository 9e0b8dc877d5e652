#pragma once
// Errors that the library throws. what() is a sentence for the user.

#include <cstddef>
#include <stdexcept>
#include <string>

#include "dmoscope/export.h"

namespace dmo {

/// Base of all errors of the library.
class DMO_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~Error() override;
};

/// Error in a file's content, or in an array: "file:line: what is wrong".
class DMO_API InputError : public Error {
 public:
  InputError(const std::string& what, std::string file, std::size_t line);
  ~InputError() override;
  /// The file's path; empty if no file is to blame.
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// The line, from 1 on; 0 if there is none.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  std::string file_;
  std::size_t line_;
};

/// A file could not be written; a former file of that name is unchanged.
class DMO_API OutputError : public Error {
 public:
  using Error::Error;
  ~OutputError() override;
};

/// A request for something that does not exist or does not fit: an unknown metric, an option out of range.
class DMO_API UsageError : public Error {
 public:
  using Error::Error;
  ~UsageError() override;
};

/// A cancel was requested and there is no result so far to return: see Progress.
class DMO_API Cancelled : public Error {
 public:
  using Error::Error;
  ~Cancelled() override;
};

}  // namespace dmo
