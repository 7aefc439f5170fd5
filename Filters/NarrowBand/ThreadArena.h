/**
 * The arenas of TBB in which bands are moved.
 */
#ifndef ThreadArena_h
#define ThreadArena_h

#include <tbb/task_arena.h>

namespace activesurface
{

/** Of the calling thread; threads: at most, 0: all that there are. */
tbb::task_arena& FindArena(int threads);

}

#endif
