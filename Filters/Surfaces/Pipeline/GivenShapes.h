// Whether a surface has what it needs: one target, and one initial shape at most.

#ifndef GivenShapes_h
#define GivenShapes_h

namespace activesurface
{

struct SurfaceInputs;

// What comes through the ports; a composite data set is no shape.
struct GivenShapes
{
  bool TargetInput = false;
  bool InitialInput = false;
  bool TargetIsComposite = false;
  bool InitialIsComposite = false;
};

// With the functions of the settings. Throws std::invalid_argument; of composite data RankError, as
// they are composite on all ranks, which VTK calls as often as each has blocks: no round is common.
void CheckShapes(const SurfaceInputs& functions, const GivenShapes& given);

}

#endif
