// What skeletons use of rclcpp (humble and later): its signatures, and enough behind them to run
// in one process. No ROS is behind it.
#ifndef STUB_RCLCPP_HPP_
#define STUB_RCLCPP_HPP_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "rcl_interfaces/msg/parameter_descriptor.hpp"

#define RCLCPP_ERROR(logger, ...) \
  do {(void)(logger); std::fprintf(stderr, __VA_ARGS__); std::fputc('\n', stderr);} while (0)
#define RCLCPP_INFO(logger, ...) RCLCPP_ERROR(logger, __VA_ARGS__)

struct rmw_request_id_t {};

namespace rclcpp
{

inline bool & running()
{
  static bool value = false;
  return value;
}
inline void init(int, const char * const *) {running() = true;}
inline bool ok() {return running();}

class Context
{
public:
  void add_pre_shutdown_callback(std::function<void()> callback) {callbacks_.push_back(callback);}
  void shutdown()
  {
    for (const auto & callback : callbacks_) {
      callback();
    }
    callbacks_.clear();
    running() = false;
  }

private:
  std::vector<std::function<void()>> callbacks_;
};
namespace contexts
{
inline std::shared_ptr<Context> get_global_default_context()
{
  static const auto context = std::make_shared<Context>();
  return context;
}
}  // namespace contexts
inline bool shutdown() {contexts::get_global_default_context()->shutdown(); return true;}

class Duration
{
public:
  static Duration from_seconds(double seconds) {return Duration(seconds);}
  double seconds() const {return seconds_;}

private:
  explicit Duration(double seconds) : seconds_(seconds) {}
  double seconds_;
};

class Time
{
public:
  explicit Time(double seconds = 0) : seconds_(seconds) {}
  Time operator+(const Duration & other) const {return Time(seconds_ + other.seconds());}
  Duration operator-(const Time & other) const
  {
    return Duration::from_seconds(seconds_ - other.seconds_);
  }

private:
  double seconds_;
};

class QoS
{
public:
  QoS(std::size_t depth) : depth_(depth) {}  // NOLINT: not explicit there either
  std::size_t depth_;
};

using Value = std::variant<
  bool, std::int64_t, double, std::string, std::vector<bool>, std::vector<std::int64_t>,
  std::vector<double>, std::vector<std::string>>;

class NodeOptions
{
public:
  template<typename T>
  NodeOptions & append_parameter_override(const std::string & name, const T & value)
  {
    given[name] = value;
    return *this;
  }
  std::map<std::string, Value> given;
};

enum class CallbackGroupType {MutuallyExclusive, Reentrant};
struct CallbackGroup
{
  using SharedPtr = std::shared_ptr<CallbackGroup>;
};
struct SubscriptionOptions
{
  CallbackGroup::SharedPtr callback_group;
};
struct SubscriptionBase
{
  using SharedPtr = std::shared_ptr<SubscriptionBase>;
  virtual ~SubscriptionBase() = default;
};
template<typename M>
struct Subscription : SubscriptionBase
{
  std::function<void(std::shared_ptr<const M>)> callback;
};
struct ServiceBase
{
  using SharedPtr = std::shared_ptr<ServiceBase>;
  virtual ~ServiceBase() = default;
};
template<typename S>
struct Service : ServiceBase
{
  using SharedPtr = std::shared_ptr<Service<S>>;
  std::function<void(std::shared_ptr<typename S::Request>, std::shared_ptr<typename S::Response>)>
  callback;
  std::function<void(
      std::shared_ptr<Service<S>>, std::shared_ptr<rmw_request_id_t>,
      std::shared_ptr<typename S::Request>)>
  deferring_callback;
  void send_response(rmw_request_id_t &, typename S::Response & response)
  {
    responses.push_back(response);
  }
  std::vector<typename S::Response> responses;
};
struct TimerBase
{
  using SharedPtr = std::shared_ptr<TimerBase>;
  void cancel() {cancelled = true;}
  std::function<void()> callback;
  bool cancelled = false;
};
template<typename M>
class Publisher
{
public:
  using SharedPtr = std::shared_ptr<Publisher<M>>;
  void publish(const M & message) {published.push_back(message);}
  std::vector<M> published;
};
struct Logger {};

class Node : public std::enable_shared_from_this<Node>
{
public:
  explicit Node(const std::string & name, const NodeOptions & options = NodeOptions())
  : name_(name), options_(options) {}
  virtual ~Node() = default;
  const char * get_name() const {return name_.c_str();}
  Logger get_logger() const {return Logger();}
  Time now() const
  {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return Time(std::chrono::duration<double>(since).count());
  }
  template<typename T>
  auto declare_parameter(
    const std::string & name, const T & value,
    const rcl_interfaces::msg::ParameterDescriptor & = {}, bool = false)
  {
    const auto found = options_.given.find(name);
    return found == options_.given.end() ? value : std::get<T>(found->second);
  }
  template<typename T>
  auto declare_parameter(
    const std::string & name, const rcl_interfaces::msg::ParameterDescriptor & = {}, bool = false)
  {
    const auto found = options_.given.find(name);
    if (found == options_.given.end()) {
      throw std::runtime_error("parameter '" + name + "' is not initialized");
    }
    return std::get<T>(found->second);
  }
  template<typename M>
  typename Publisher<M>::SharedPtr create_publisher(const std::string &, const QoS &)
  {
    return std::make_shared<Publisher<M>>();
  }
  CallbackGroup::SharedPtr create_callback_group(CallbackGroupType, bool = true)
  {
    return std::make_shared<CallbackGroup>();
  }
  template<typename M, typename C>
  typename std::shared_ptr<Subscription<M>> create_subscription(
    const std::string & topic, const QoS &, C && callback,
    const SubscriptionOptions & = SubscriptionOptions())
  {
    auto made = std::make_shared<Subscription<M>>();
    made->callback = std::forward<C>(callback);
    subscriptions[topic] = made;
    return made;
  }
  template<typename S, typename C>
  typename std::shared_ptr<Service<S>> create_service(const std::string & name, C && callback)
  {
    using Request = std::shared_ptr<typename S::Request>;
    auto made = std::make_shared<Service<S>>();
    if constexpr (std::is_invocable_v<C, Request, std::shared_ptr<typename S::Response>>) {
      made->callback = std::forward<C>(callback);
    } else {
      made->deferring_callback = std::forward<C>(callback);
    }
    services[name] = made;
    return made;
  }
  template<typename Rep, typename Period, typename C>
  TimerBase::SharedPtr create_wall_timer(std::chrono::duration<Rep, Period>, C && callback)
  {
    auto made = std::make_shared<TimerBase>();
    made->callback = std::forward<C>(callback);
    timers.push_back(made);
    return made;
  }
  // For who drives the stub.
  std::map<std::string, SubscriptionBase::SharedPtr> subscriptions;
  std::map<std::string, std::weak_ptr<ServiceBase>> services;
  std::vector<TimerBase::SharedPtr> timers;
  std::map<std::string, std::shared_ptr<void>> actions;

private:
  std::string name_;
  NodeOptions options_;
};

struct ExecutorOptions {};
namespace executors
{
class MultiThreadedExecutor
{
public:
  explicit MultiThreadedExecutor(
    const ExecutorOptions & = ExecutorOptions(), std::size_t = 0) {}
  void add_node(std::shared_ptr<Node> added, bool = true) {node = added;}
  void spin();  // what happens while a node spins is up to the test
  std::shared_ptr<Node> node;
};
}  // namespace executors

}  // namespace rclcpp

#endif  // STUB_RCLCPP_HPP_
