#pragma once
// The one exception of the project: something the user must know, in one sentence.

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace waylight {

// What went wrong, naming the file or field at fault and the remedy. Tools print it as
// `tool: message` and exit with code 1 (failure) or, for `Misuse`, 2.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An option out of its legal range or a contradiction between options.
class Misuse : public Error {
 public:
  using Error::Error;
};

template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

// For the validate() of an Options struct: throws Misuse naming the field.
template <typename... Args>
void require(bool condition, fmt::format_string<Args...> format, Args&&... args) {
  if (!condition) throw Misuse(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace waylight
