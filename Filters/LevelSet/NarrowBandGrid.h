/**
 * The potential of a NarrowBand as an OpenVDB grid, for reading and for files.
 */
#ifndef NarrowBandGrid_h
#define NarrowBandGrid_h

#include "Base/OpenVDB.h"
#include "NarrowBand.h"

#include <memory>

namespace activesurface
{

/** Returns u = phi / VoxelSize. Layers 0 to 2 and pockets (NarrowBand.h) are active; the other
 * nodes of layers 3 and 4 are inactive nodes of leaves. */
ACTIVELEVELSET_EXPORT openvdb::FloatGrid::ConstPtr GetPotential(const NarrowBand& band);

///@{
/**
 * Convert the state, except GetWork and the limits of threads and active voxels, to a grid for
 * files and back, lossless. Active nodes have the potential, other nodes + or - the background; the
 * metadata contain the other numbers of the state. If the band has no ghosts, all nodes of the
 * layers are active. FromGrid throws std::runtime_error like ReadStateGrid (State/StateGrid.h), and
 * std::invalid_argument if VoxelSize is not > 0.
 */
ACTIVELEVELSET_EXPORT openvdb::FloatGrid::Ptr ToGrid(const NarrowBand& band);
ACTIVELEVELSET_EXPORT std::unique_ptr<NarrowBand> FromGrid(const openvdb::FloatGrid& grid);
///@}

}

#endif
