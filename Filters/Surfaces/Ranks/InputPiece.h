// The piece of an input on one rank, reduced to the needed data.
//
// Each rank requests its own piece. The pieces of meshes, skeletons and images are sent to all
// ranks and assembled to the whole input on each rank (PieceGather.h); particles may stay
// distributed instead (Targets/OwnedParticles.h). Data at the border of two pieces occur once in
// the whole: ghosts are omitted, equal points of meshes and of segments are merged later
// (MeshTriangles.h, SkeletonInput.h), and nodes of images are identified by their index.

#ifndef InputPiece_h
#define InputPiece_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkAbstractArray;
class vtkDataSet;
class vtkImageData;
class vtkInformation;
class vtkPointSet;
class vtkPolyData;

namespace activesurface
{

// Requests this rank's piece without ghost layers; for an image, the block of this rank.
void RequestPiece(vtkInformation* input, int rank, int size);

enum class PieceKind : char
{
  Nothing = 'n',
  Particles = 'p',
  Cells = 'c', // a mesh or a skeleton
  Image = 'i',
  GridImage = 'g' // an image with an attached grid, which is complete on each rank that has one
};

struct InputPiece
{
  PieceKind Kind = PieceKind::Nothing;
  vtkSmartPointer<vtkDataSet> Data; // null: nothing
};

// Point arrays to send: all, or only the chosen ones, which may be null.
struct PieceArrays
{
  bool All = false;
  std::vector<vtkAbstractArray*> Chosen;
};

// Return the needed data of an input. Without ghosts, the piece shares the input's points and
// arrays.
InputPiece MakeParticlePiece(vtkPointSet* points, const PieceArrays& arrays);
InputPiece MakeCellPiece(vtkPolyData* cells, const PieceArrays& arrays);
InputPiece MakeImagePiece(vtkImageData* image, vtkAbstractArray* values);

}

#endif
