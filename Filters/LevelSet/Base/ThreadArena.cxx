#include "Base/ThreadArena.h"

#include <map>

namespace activesurface
{

/**
 * Keeps the arenas of each thread, one for each number of workers: TBB (2021.8) leaks 7 kB per
 * arena that workers have joined.
 */
tbb::task_arena& FindArena(int threads)
{
  thread_local std::map<int, tbb::task_arena> arenas;
  const int concurrency = threads > 0 ? threads : tbb::task_arena::automatic;
  return arenas.try_emplace(concurrency, concurrency).first->second;
}

}
