#pragma once
// What the library throws. what() is a sentence for a person.

#include <cstddef>
#include <stdexcept>
#include <string>

#include "dmoscope/export.h"

namespace dmo {

/// Base of all of them.
class DMO_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~Error() override;
};

/// A file's content, or an array, is wrong: "file:line: what is wrong".
class DMO_API InputError : public Error {
 public:
  InputError(const std::string& what, std::string file, std::size_t line);
  ~InputError() override;
  /// Empty where no file is to blame.
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// From 1 on; 0 where a line makes no sense.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  std::string file_;
  std::size_t line_;
};

/// A file could not be written; an old one of that name stands as it was.
class DMO_API OutputError : public Error {
 public:
  using Error::Error;
  ~OutputError() override;
};

/// Something was asked for that does not exist or does not fit: an unknown metric, an option out of range.
class DMO_API UsageError : public Error {
 public:
  using Error::Error;
  ~UsageError() override;
};

/// A cancel was requested where there is nothing half done to give back: see Progress.
class DMO_API Cancelled : public Error {
 public:
  using Error::Error;
  ~Cancelled() override;
};

}  // namespace dmo
