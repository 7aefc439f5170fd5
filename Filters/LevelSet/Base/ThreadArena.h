/**
 * TBB arenas in which bands are moved.
 */
#ifndef ThreadArena_h
#define ThreadArena_h

#include <tbb/task_arena.h>

namespace activesurface
{

/** Returns the arena of the calling thread for at most `threads` threads; 0: all. */
tbb::task_arena& FindArena(int threads);

}

#endif
