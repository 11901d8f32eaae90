// A reference to a callable, like std::function_ref of C++26.
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>

#include "octoblisk/cpp20.h"

namespace octoblisk {

template <typename Signature>
class FunctionRef;

/// A parameter type for functions that call back. It does not own the callable and never allocates, so the
/// callable must outlive it.
template <typename Result, typename... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <typename Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, FunctionRef> &&
           std::is_invocable_r_v<Result, Callable&, Arguments...>) FunctionRef(Callable&& callable)
      : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* called, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<Callable>*>(called))(arguments...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(callable_, arguments...); }

 private:
  void* callable_;
  Result (*call_)(void* called, Arguments... arguments);
};

}  // namespace octoblisk
