/**
 * The active implicit surface: a potential stored near the surface, advanced in time.
 *
 * M. Desbrun, M.-P. Cani-Gascuel, Active Implicit Surface for Animation, Graphics Interface 1998
 * ("the paper"). The surface S(t) is the zero set of a potential phi stored on the nodes of a
 * lattice near it, and moves along its normal with the speed V of Motion.h:
 *
 *   d phi / dt + V |grad phi| = 0,   n = grad phi / |grad phi|
 *
 * SIGN: phi is NEGATIVE INSIDE; n points outward; V > 0 inflates. The paper's f is -phi up to
 * scale.
 *
 * STORAGE: an openvdb::FloatGrid holding u = phi / VoxelSize. Node (i,j,k) is at world position
 * (i,j,k) * VoxelSize, so lattices of the same VoxelSize coincide in all runs. (The grid's own
 * transform is the identity: OpenVDB's refuses voxels below about 1e-5, whatever the unit.) Layer 0
 * are the corners of the voxels that the surface crosses, layer m the 6-neighbours of layer m - 1.
 * Layers 0..2 are active in the grid; layers 3 and 4 are ghosts, inactive values in the same
 * leaves, extrapolated from inside after every substep (a ring node all of whose stencil lies in
 * the layers, at a medial axis, is a "pocket" and active too). Everything else is + or - Far, of
 * which only the sign means anything. Inside the layers u keeps its own slope (about .5 to 1.5);
 * where a distance is wanted, it is divided by that slope on the way out.
 *
 * REPRODUCIBILITY: the potential after Advance depends on the times and the motion alone, bitwise,
 * not on the number of threads nor on the history of the memory.
 */
#ifndef NarrowBand_h
#define NarrowBand_h

#include "InitialFunction.h"
#include "Motion.h"
#include "Target.h"
#include "vtkActiveNarrowBandModule.h"

#include <openvdb/openvdb.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace activesurface
{

struct BandState;
class LeafTable;

class VTKACTIVENARROWBAND_EXPORT NarrowBand
{
public:
  /**
   * voxelSize: distance of the nodes [world units], finite and > 0, else std::invalid_argument.
   */
  explicit NarrowBand(double voxelSize);
  ~NarrowBand();

  /** A copy with its own potential: a branch that leaves this trajectory untouched. */
  std::unique_ptr<NarrowBand> Clone() const;

  ///@{
  /**
   * The state as bytes, without loss, and the band made of them, which goes on to the same bytes:
   * less than 4 per active voxel. For this process, not for files. The work done (GetWork) is not
   * in them.
   */
  std::string Pack() const;
  static std::unique_ptr<NarrowBand> Unpack(const std::string& bytes);
  ///@}

  ///@{
  /**
   * The state as a grid for files, without loss: the potential at the active nodes, + or - the
   * background elsewhere, and as metadata all else (but GetWork). FromGrid throws
   * std::runtime_error for a grid that is no such state.
   */
  openvdb::FloatGrid::Ptr ToGrid() const;
  static std::unique_ptr<NarrowBand> FromGrid(const openvdb::FloatGrid& grid);
  ///@}

  /** Threads that TBB may use, 1024 at most; 0: all. The result does not depend on it. */
  void SetNumberOfThreads(int threads);

  /**
   * Guard: Start throws std::runtime_error, and leaves an empty surface, when the band would hold
   * more active nodes than this, or the bounds so many voxels that a shape which fills them would.
   * Advance throws after the substep in which the band has grown beyond it.
   */
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum);

  /**
   * Sets the potential to the zero set of a function within bounds (xmin xmax ymin ymax zmin zmax;
   * closed at their faces where the function is negative there), and the time. Memory is
   * proportional to the surface and two planes of the lattice. A function without zero set gives an
   * empty surface. Throws std::invalid_argument for bounds that are empty, not finite or absurd for
   * the voxel size, std::runtime_error beyond the maximum number of active voxels.
   * Returns false when `progress` stopped it; the surface is then empty.
   */
  bool Start(double time, const double bounds[6], const InitialFunction& function,
    const ProgressFunction& progress = {});

  /** Takes the surface back within walls, where it is beyond them. */
  void Confine(const Walls& walls);

  /**
   * Moves the surface to the motion time `time` (not before the current one, else
   * std::invalid_argument); substeps end exactly there. An exception (of the target, or the
   * guard's) leaves the potential and GetTime() as after the last finished substep.
   */
  AdvanceReport Advance(
    double time, const Motion& motion, Target& target, const ProgressFunction& progress = {});

  /**
   * Moves the surface until it rests: until its normal speed at the sample points, everything
   * included, is within the tolerance, or the substeps are used up; the report says which. Time
   * goes on meanwhile. Errors as with Advance.
   */
  AdvanceReport Settle(const Motion& motion, const RestCriterion& criterion, Target& target,
    const ProgressFunction& progress = {});

  ///@{
  /** What was done since the start or the last ForgetWork, also by calls that ended in an
   * exception: the numbers, and the largest speed. A clone has it too. */
  const AdvanceReport& GetWork() const;
  void ForgetWork();
  ///@}

  ///@{
  /** Of the skin now, and at the start [length^2, length^3]; voids are taken off. */
  double GetArea() const;
  double GetVolume() const;
  double GetStartArea() const;
  double GetStartVolume() const;
  ///@}

  double GetVoxelSize() const;
  double GetTime() const;
  bool IsEmpty() const;
  std::size_t GetNumberOfActiveNodes() const;
  std::size_t GetNumberOfGhosts() const;

  /** Runs a function where TBB uses no more threads than SetNumberOfThreads allows. */
  void Run(const std::function<void()>& function) const;

  /** u = phi / VoxelSize; active mask = band, the ghosts are inactive values in the same leaves. */
  openvdb::FloatGrid::ConstPtr GetPotential() const;

  /** The leaves of the potential with their masks, for the polygoniser and the exporters. */
  const LeafTable& GetLeaves() const;

private:
  NarrowBand(const NarrowBand&) = delete;
  void operator=(const NarrowBand&) = delete;

  std::unique_ptr<BandState> State;
};

}

#endif
