#include "Base/StaticShutdown.h"

#include <atomic>
#include <utility>

namespace activesurface
{

namespace
{

std::atomic<bool> IsExiting{ false };

/** A static object that is constructed after TBB's static objects, and therefore destroyed before
 * TBB's. Trees released after the sentinel's destruction are leaked, because freeing a tree needs
 * TBB. */
struct ExitSentinel
{
  ~ExitSentinel() { IsExiting = true; }
};
const ExitSentinel Sentinel;

}

void ReleaseUnlessExiting(std::shared_ptr<const void> holder)
{
  if (IsExiting)
  {
    new std::shared_ptr<const void>(std::move(holder));
  }
}

}
