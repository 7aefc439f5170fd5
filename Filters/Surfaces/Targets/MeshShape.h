/**
 * Polygons: the distance to a mesh or, if the mesh is open and MeshThickness > 0, to a shell around
 * the mesh (vtkGridPotential).
 */
#ifndef MeshShape_h
#define MeshShape_h

#include "Targets/FunctionShape.h"
#include "Targets/InputData.h"

namespace activesurface
{

class MeshShape : public FunctionShape
{
public:
  static bool Fits(vtkDataSet* data);

  /** Throws std::invalid_argument if there are also lines. */
  explicit MeshShape(const InputData& input);

  const char* GetName() const override { return "a mesh"; }
  bool CanStart() const override { return true; }

  /** Points without cells may be a mesh that has lost all polygons. */
  bool IsEmptyAs(const InputShape& other) const override { return !other.HasCells(); }

  std::string Prepare(const TargetOptions& options, const Warnings& messages) override;
  std::string DescribeThinParts(const TargetOptions& options) const override;
  void AddBounds(
    const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const override;
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const override;
};

}

#endif
