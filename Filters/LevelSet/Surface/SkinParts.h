/**
 * The connected parts of the skin: each is the outer boundary of a body, or the boundary of a void.
 */
#ifndef SkinParts_h
#define SkinParts_h

#include "ActiveLevelSetExport.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

class NarrowBand;

/** Index of a block, a cube of four voxels a side. Blocks give the rough position of a part. */
using PartBlock = std::array<std::int32_t, 3>;
constexpr int VoxelsOfBlock = 4;

struct SkinPart
{
  double Area = 0.0;                    //< world units
  double Volume = 0.0;                  //< enclosed; negative for a void
  std::int64_t EulerCharacteristic = 0; //< 2 - 2 * handles
  std::vector<PartBlock> Blocks;        //< blocks that contain vertices of the part, ascending

  bool IsVoid() const { return !(this->Volume > 0.0); }
};

/** Returns the parts in the order of their first vertices; equal potentials give bitwise identical
 * parts. Collective if the band is partitioned among ranks: rank 0 gets all parts, other ranks
 * none. */
ACTIVELEVELSET_EXPORT std::vector<SkinPart> FindSkinParts(const NarrowBand& band);

}

#endif
