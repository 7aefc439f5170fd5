// Checks that a surface has exactly one target and at most one initial shape.

#ifndef GivenShapes_h
#define GivenShapes_h

namespace activesurface
{

struct SurfaceInputs;

// Inputs of the ports. A composite data set is not accepted as a shape.
struct GivenShapes
{
  bool TargetInput = false;
  bool InitialInput = false;
  bool TargetIsComposite = false;
  bool InitialIsComposite = false;
};

// Throws std::invalid_argument if a target is missing, or if there are two targets or two initial
// shapes. Throws RankError for composite data: VTK calls each rank once for each of its blocks, so
// the ranks have no common collective call. Data are composite on all ranks or on none, so all
// ranks throw.
void CheckShapes(const SurfaceInputs& functions, const GivenShapes& given);

}

#endif
