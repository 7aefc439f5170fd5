#include "ThreadArena.h"

#include <map>

namespace activesurface
{

/**
 * Each thread that moves bands keeps its arenas, one for each number of workers: TBB (2021.8) loses
 * 7 kB with each arena that workers have joined.
 */
tbb::task_arena& FindArena(int threads)
{
  thread_local std::map<int, tbb::task_arena> arenas;
  const int concurrency = threads > 0 ? threads : tbb::task_arena::automatic;
  return arenas.try_emplace(concurrency, concurrency).first->second;
}

}
