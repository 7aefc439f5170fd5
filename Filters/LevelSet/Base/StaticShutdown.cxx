#include "Base/StaticShutdown.h"

#include <atomic>
#include <utility>

namespace activesurface
{

namespace
{

std::atomic<bool> IsExiting{ false };

/** A static object constructed after TBB's, so destroyed before them. Trees released later are
 * leaked, because freeing them needs TBB. */
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
