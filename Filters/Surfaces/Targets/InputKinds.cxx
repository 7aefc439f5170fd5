/** The kinds of input, and the choice of the kind for a data set. */

#include "Targets/ContentSum.h"
#include "Targets/ImageShape.h"
#include "Targets/InputData.h"
#include "Targets/MeshShape.h"
#include "Targets/NoShape.h"
#include "Targets/ParticleShape.h"
#include "Targets/SkeletonShape.h"

#include <stdexcept>

namespace activesurface
{

namespace
{

struct InputKind
{
  bool (*Fits)(vtkDataSet* data); // data is not null
  std::unique_ptr<InputShape> (*Make)(const InputData& input);
};

template <class Shape>
constexpr InputKind KindOf()
{
  return { Shape::Fits, [](const InputData& input) -> std::unique_ptr<InputShape> {
            return std::make_unique<Shape>(input);
          } };
}

// The first kind that fits is used.
constexpr InputKind Kinds[] = {
  KindOf<NoShape>(),
  KindOf<ImageShape>(),
  KindOf<MeshShape>(),
  KindOf<SkeletonShape>(),
  KindOf<ParticleShape>(),
};

}

std::unique_ptr<InputShape> MakeInputShape(const InputData& input)
{
  for (const InputKind& kind : Kinds)
  {
    if (input.Data && kind.Fits(input.Data))
    {
      std::unique_ptr<InputShape> shape = kind.Make(input);
      shape->Content = SumContent(input.Data);
      return shape;
    }
  }
  throw std::invalid_argument(
    "Data that are neither points nor an image cannot be an input: connect a vtkPointSet or a "
    "vtkImageData.");
}

}
