#pragma once
namespace demo::srv
{
struct CameraSnap
{
  struct Request
  {
    double zoom = 0;
  };
  struct Response
  {
    bool stored = false;
  };
};
}  // namespace demo::srv
