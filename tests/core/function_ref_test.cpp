#include "octoblisk/function_ref.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace octoblisk {
namespace {

int twice(FunctionRef<int(int)> function, int number) { return function(function(number)); }

TEST(FunctionRef, refersToTheCallable) {
  int calls = 0;
  auto count = [calls](int number) mutable { return number + ++calls; };
  EXPECT_EQ(twice(count, 10), 13);
  EXPECT_EQ(count(0), 3);  // the same object, not a copy
  const FunctionRef<int(int)> reference = count;
  EXPECT_EQ(twice(reference, 0), 9);
}

TEST(FunctionRef, passesConstCallablesAndReferences) {
  struct Doubling {
    void operator()(double& number) const { number *= 2.0; }
  };
  const Doubling doubling;
  double number = 1.5;
  const FunctionRef<void(double&)> reference = doubling;
  reference(number);
  EXPECT_EQ(number, 3.0);
}

static_assert(!std::is_constructible_v<FunctionRef<int(int)>, int>);
static_assert(!std::is_constructible_v<FunctionRef<int(int)>, void (*)(double&)>);

}  // namespace
}  // namespace octoblisk
