/**
 * Release of trees at the end of a program. OpenVDB frees trees by means of TBB, but ParaView
 * deletes its objects after TBB's static objects are destroyed. Freeing a tree at that time would
 * abort a finished program.
 */
#ifndef StaticShutdown_h
#define StaticShutdown_h

#include "ActiveLevelSetExport.h"

#include <memory>

namespace activesurface
{

/** Releases an object that may own a tree. After this library's static objects are destroyed, the
 * object is leaked. */
ACTIVELEVELSET_EXPORT void ReleaseUnlessExiting(std::shared_ptr<const void> holder);

}

#endif
