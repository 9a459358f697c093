#pragma once
#include <cstdint>
#include <string>
namespace demo::srv
{
struct Beep
{
  struct Request
  {
    std::uint8_t times = 0;
  };
  struct Response
  {
    bool success = false;
    std::string message;
  };
};
}  // namespace demo::srv
