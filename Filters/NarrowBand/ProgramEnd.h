/**
 * OpenVDB frees trees with TBB, which has gone when ParaView's own objects are deleted at the end
 * of a program: it would abort after all work is done.
 */
#ifndef ProgramEnd_h
#define ProgramEnd_h

#include "vtkActiveNarrowBandModule.h"

#include <memory>

namespace activesurface
{

/** Gives up what may hold a tree; once the program ends, its memory is left to the system. */
VTKACTIVENARROWBAND_EXPORT void LetGo(std::shared_ptr<const void> holder);

}

#endif
