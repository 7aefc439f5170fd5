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
 * leaves, extrapolated from inside after every substep. (A ghost whose whole stencil lies in the
 * layers, at a medial axis, is a "pocket" and active too.) All other nodes are + or - Far, of which
 * only the sign has a meaning. Inside the layers the gradient norm of u is about .5 to 1.5; output
 * distances are u divided by it.
 *
 * REPRODUCIBILITY: the potential after Advance depends, bitwise, on the times and the motion alone:
 * not on the number of threads, nor on what the memory held before.
 */
#ifndef NarrowBand_h
#define NarrowBand_h

#include "ActiveLevelSetExport.h"
#include "Base/InitialFunction.h"
#include "Base/Motion.h"
#include "Base/Target.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

struct BandPart;
struct BandState;
struct LeafCost;
class Domain;
class LeafTable;

class ACTIVELEVELSET_EXPORT NarrowBand
{
public:
  /**
   * voxelSize: distance of the nodes [world units], finite and > 0, else std::invalid_argument.
   */
  explicit NarrowBand(double voxelSize);
  ~NarrowBand();

  /** A copy with its own potential: a branch that does not change this trajectory. */
  std::unique_ptr<NarrowBand> Clone() const;
  /** The part of the surface within walls, closed at them; its work and time are those of this. */
  std::unique_ptr<NarrowBand> MakePartWithin(const Walls& walls) const;

  /** Extends the potential beyond the band, unless it is: after a frame of the node scheme it ends
   * at 3 voxels. Substeps do so themselves. */
  void AddGhosts();
  bool HasGhosts() const;

  ///@{
  /**
   * The state as bytes, without loss (see State/PackedBand.h); and the band restored from
   * them, whose further motion gives the same bytes. For this process, not for files. Without the
   * work done (GetWork). part: SharePart of the band.
   */
  std::string Pack() const;
  static std::unique_ptr<NarrowBand> Unpack(
    const std::string& bytes, const std::shared_ptr<const BandPart>& part = nullptr);
  ///@}

  ///@{
  /**
   * Bands on several ranks that are parts of one. After SetDomain the next frames of the node
   * scheme are such parts: Start and Advance are collective then, and areas, volumes and numbers of
   * nodes are those of all ranks. null: they are whole.
   */
  void SetDomain(const std::shared_ptr<const Domain>& domain);
  /** Null if the band is whole. */
  const BandPart* GetPart() const;
  std::shared_ptr<const BandPart> SharePart() const;
  /** Adds what this rank's leaves cost. */
  void ListCosts(std::vector<LeafCost>& costs) const;
  /** The whole band, on all ranks or on the first one; else null. Collective; only for a part. */
  std::unique_ptr<NarrowBand> GatherWhole(bool onAll) const;
  /** Makes a part the whole, and the next frames too. Collective. */
  void MakeWhole();
  ///@}

  /** Threads that TBB may use, 1024 at most; 0: all. The result does not depend on it. */
  void SetNumberOfThreads(int threads);

  /**
   * Limit of the memory. Start throws std::runtime_error and leaves an empty surface if the band
   * would have more active nodes, or if a shape that fills the bounds would. Advance throws after
   * the substep in which the band exceeds it, and before any other one as long as it does.
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

  /**
   * Sets the potential to the target at the time, which has to have nodes, after attraction and
   * tension of such a duration: so the first frame is as smooth as those that follow. bounds: only
   * their size is used. Errors as with Advance.
   */
  void StartOnNodes(
    double time, const double bounds[6], const Motion& motion, double duration, Target& target);

  /** Creates the parts and hollows that the target tells of, where the surface does not reach them;
   * see Motion::CreateParts. Returns how many. Errors as with Advance. */
  std::size_t CreateParts(const Motion& motion, const Target& target);

  /** Clips the surface at the walls, if they are present, and at the obstacle, unless it is null.
   * Throws std::runtime_error where the obstacle is not a number. */
  void Confine(const Walls& walls, Obstacle* obstacle = nullptr);

  /** Moves the surface along its normal until it has the TargetVolume or TargetArea of an exact
   * control, so that the first frame has it too; nothing without one. Counts as the start. */
  void RestoreTargets(const Motion& motion);

  /**
   * Moves the surface to the motion time `time` (not before the current one, else
   * std::invalid_argument); substeps end exactly there. An exception (of the target, or the
   * guard's) leaves the potential and GetTime() as after the last finished substep.
   */
  AdvanceReport Advance(
    double time, const Motion& motion, Target& target, const ProgressFunction& progress = {});

  /**
   * Moves the surface until it is steady: until its normal speed at the sample points, from all
   * terms, is within the tolerance, or the maximum of substeps is reached; the report says which.
   * Time advances too. Errors as with Advance.
   */
  AdvanceReport AdvanceToSteadyState(const Motion& motion, const SteadyStateCriterion& criterion,
    Target& target, const ProgressFunction& progress = {});

  ///@{
  /** The sums of the reports since the start or the last ForgetWork, including calls that ended in
   * an exception, and the largest speed. Copied by Clone. */
  const AdvanceReport& GetWork() const;
  void ForgetWork();
  ///@}

  ///@{
  /** Area and volume of the skin, now and at the start [length^2, length^3], without voids. */
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

  /** Runs a function with the threads that SetNumberOfThreads allows. */
  void Run(const std::function<void()>& function) const;

  /** The leaves of the potential with their masks, for the polygoniser and the exporters. */
  const LeafTable& GetLeaves() const;

  ///@{
  /** The members, for NarrowBandGrid.h. */
  BandState& GetState() { return *this->State; }
  const BandState& GetState() const { return *this->State; }
  ///@}

private:
  NarrowBand(const NarrowBand&) = delete;
  void operator=(const NarrowBand&) = delete;
  void CopyNumbersTo(NarrowBand& copy) const;

  std::unique_ptr<BandState> State;
};

}

#endif
