// What a rank has of an input, and what all ranks have together.
//
// A rank asks for its own piece. What it gets is reduced to what is needed, and sent to all others;
// each rank puts the pieces together to the same whole. What two pieces share at their border is in
// the whole once: ghosts are left out, equal points of meshes are merged later (see
// MeshTriangles.h), and nodes of images have one place.

#ifndef InputPiece_h
#define InputPiece_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkAbstractArray;
class vtkDataSet;
class vtkIdList;
class vtkImageData;
class vtkInformation;
class vtkPointSet;
class vtkPolyData;

namespace activesurface
{

// The piece of this rank, without ghosts; of an image, its block.
void RequestPiece(vtkInformation* input, int rank, int size);

enum class PieceKind : char
{
  Nothing = 'n',
  Particles = 'p',
  Cells = 'c', // a mesh or a skeleton
  Image = 'i',
  GridImage = 'g' // an image that has a grid attached, which is whole on each rank that has one
};

struct InputPiece
{
  PieceKind Kind = PieceKind::Nothing;
  vtkSmartPointer<vtkDataSet> Data; // null: nothing
};

// Arrays: all point arrays, or those of the list, of which some may be null.
struct PieceArrays
{
  bool All = false;
  std::vector<vtkAbstractArray*> Chosen;
};

// Some points with their arrays; a cell of them if there are cells.
vtkSmartPointer<vtkPolyData> SelectPoints(vtkPolyData* points, vtkIdList* selected);

// Copies refer to the same arrays where nothing is left out.
InputPiece MakeParticlePiece(vtkPointSet* points, const PieceArrays& arrays);
InputPiece MakeCellPiece(vtkPolyData* cells, const PieceArrays& arrays);
InputPiece MakeImagePiece(vtkImageData* image, vtkAbstractArray* values);

}

#endif
