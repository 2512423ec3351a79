extern "C" {
#include "cancel.h"
}
#include "cancel.hpp"
#include "failure.hpp"

#include <atomic>

namespace
{

std::atomic<bool (*)()> asked;

} // namespace

extern "C" void cancel_ask(bool (*is_wanted)())
{
    asked = is_wanted;
}

void cancel_check()
{
    bool (*const is_wanted)() = asked.load(std::memory_order_relaxed);

    if (is_wanted && is_wanted()) throw failure("interrupted");
}
