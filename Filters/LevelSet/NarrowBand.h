/**
 * The active implicit surface: a potential stored near the surface, advanced in time.
 *
 * M. Desbrun, M.-P. Cani-Gascuel, Active Implicit Surface for Animation, Graphics Interface 1998
 * ("the paper"). The surface S(t) is the zero set of a potential phi, which is stored on the
 * lattice nodes near S(t). The surface moves along its normal with the speed V of Motion.h:
 *
 *   d phi / dt + V |grad phi| = 0,   n = grad phi / |grad phi|
 *
 * SIGN: phi is NEGATIVE INSIDE; n points outward; V > 0 inflates. The paper's f is -phi up to
 * scale.
 *
 * STORAGE: an openvdb::FloatGrid of u = phi / VoxelSize. The world position of node (i,j,k) is
 * VoxelSize times (i,j,k), so lattices of the same VoxelSize coincide in all runs. The grid's own
 * transform is the identity, because OpenVDB rejects voxels below about 1e-5 in any unit.
 *
 * Layer 0 consists of the corners of the voxels that the surface crosses. Layer m consists of the
 * 6-neighbours of layer m - 1 that are in no smaller layer. Layers 0..2 are active in the grid.
 * Layers 3 and 4 are ghosts: inactive nodes, extrapolated from smaller layers after every explicit
 * substep. After a frame of the node scheme without an exact control, layers 3 and 4 have values of
 * this scheme, at most 3 in magnitude. Exception: a node of layer 3 or 4 whose whole stencil lies
 * in the layers, at a medial axis, is active and is called a "pocket". All other nodes are + or -
 * Far; only their sign has a meaning. PaperStep.h describes the band of the paper's scheme. Inside
 * the layers the gradient norm of u is about 0.5 to 1.5; output distances are u divided by this
 * norm.
 *
 * REPRODUCIBILITY: the same start, times, motion and target give a bitwise identical potential,
 * with any number of threads and any previous contents of memory.
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
   * voxelSize: distance of the nodes [world units], finite and > 0. Throws std::invalid_argument
   * for other values.
   */
  explicit NarrowBand(double voxelSize);
  ~NarrowBand();

  /** Returns a copy with its own potential, without the domain of SetDomain. Motion of the copy
   * does not change this band. */
  std::unique_ptr<NarrowBand> Clone() const;
  /** Returns the part of the surface within walls, closed at the walls, with GetTime and GetWork of
   * this band. */
  std::unique_ptr<NarrowBand> MakePartWithin(const Walls& walls) const;

  /**
   * Extends the potential beyond the band by ghosts, unless the band has ghosts. After a frame of
   * the node scheme without an exact control, the potential ends at 3 voxels. Motions by explicit
   * substeps begin with the same extension.
   */
  void AddGhosts();
  bool HasGhosts() const;

  ///@{
  /**
   * Pack returns the state as bytes, lossless (see State/PackedBand.h). Unpack returns the band
   * restored from these bytes. Further motion of the restored band by Advance is bitwise identical
   * to that of the packed band. The bytes are for this process, not for files, and include neither
   * GetWork nor the limits of threads and active voxels. part: SharePart of the packed band.
   */
  std::string Pack() const;
  static std::unique_ptr<NarrowBand> Unpack(
    const std::string& bytes, const std::shared_ptr<const BandPart>& part = nullptr);
  ///@}

  ///@{
  /**
   * Bands partitioned among ranks. After SetDomain, the next frame of the node scheme makes this
   * band one rank's part of a common band. StartOnNodes and Advance are then collective, and areas,
   * volumes and the number of active nodes are totals of all ranks. domain: null for a whole band.
   */
  void SetDomain(const std::shared_ptr<const Domain>& domain);
  /** Null if the band is whole. */
  const BandPart* GetPart() const;
  std::shared_ptr<const BandPart> SharePart() const;
  /** Adds the costs of this rank's leaves if the band is a part; otherwise adds nothing. */
  void ListCosts(std::vector<LeafCost>& costs) const;
  /** Returns the whole band: on all ranks if onAll, else on rank 0, and null on other ranks.
   * Collective; only for a part. */
  std::unique_ptr<NarrowBand> GatherWhole(bool onAll) const;
  /** Replaces a part by the whole band. The next frames are not partitioned. Collective. */
  void MakeWhole();
  ///@}

  /** Number of threads for TBB, at most 1024; 0: all. Results do not depend on this number. */
  void SetNumberOfThreads(int threads);

  /**
   * Largest number of active nodes, which limits the memory. Start throws std::runtime_error and
   * leaves an empty surface if the band would have more active nodes, or if Start would sample too
   * many nodes. StartOnNodes and Advance throw if the band has more active nodes at the beginning
   * or after a substep, or would have more after new parts or a frame of the node scheme.
   */
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum);

  /**
   * Starts at a time with the zero set of a function within bounds (xmin xmax ymin ymax zmin zmax).
   * The surface is closed at faces of the bounds where the function is negative. Without boxes and
   * points (InitialFunction.h), memory is proportional to the surface and two planes of the
   * lattice. A function that is nowhere negative gives an empty surface. Throws
   * std::invalid_argument if the bounds are empty, not finite or too large for the voxel size.
   * Throws std::runtime_error beyond the maximum number of active voxels. Returns false if
   * `progress` cancelled the start; the surface is then empty.
   */
  bool Start(double time, const double bounds[6], const InitialFunction& function,
    const ProgressFunction& progress = {});

  /** Makes the potential empty: all outside. bounds: as in StartOnNodes. */
  void StartEmpty(double time, const double bounds[6]);

  /**
   * Sets the potential to the target at `time`, then applies attraction and tension for `duration`:
   * the first frame is then as smooth as the following frames. With NodeFreedom, applies only
   * tension, for 6 / Attraction. Target::GetNodes must not be null. bounds: only their size is
   * used. Throws like Advance, and for the same bounds as Start.
   */
  void StartOnNodes(
    double time, const double bounds[6], const Motion& motion, double duration, Target& target);

  /** Creates the parts and hollows that the target reports and the surface does not reach; see
   * Motion::CreateParts. Returns the number of created parts and hollows. Throws std::runtime_error
   * beyond the maximum number of active voxels. */
  std::size_t CreateParts(const Motion& motion, const Target& target);

  /** Clips the surface at the walls, if present, and at the obstacle, unless null. Throws
   * std::runtime_error if the obstacle is NaN at a node. */
  void Confine(const Walls& walls, Obstacle* obstacle = nullptr);

  /** Moves the surface along its normal to the TargetVolume or TargetArea of an exact control, or
   * as near as possible, for the first frame. Does nothing without an exact control, if its
   * TargetVolume or TargetArea is 0, or for an empty surface. Otherwise the new area and volume
   * count as those at the start. */
  void RestoreTargets(const Motion& motion);

  /**
   * Moves the surface until `time`. The last substep ends exactly at `time`, unless the surface
   * vanishes before. If `progress` cancels the motion, the surface stays at the time of the last
   * finished substep. Throws std::invalid_argument for a time before the current time, or an
   * invalid motion. If the target throws, the potential and GetTime() are those after the last
   * finished substep.
   */
  AdvanceReport Advance(
    double time, const Motion& motion, Target& target, const ProgressFunction& progress = {});

  /**
   * Makes explicit substeps until the surface is steady (IsSteady in the report) or has vanished,
   * `progress` cancels, or the maximum of substeps is reached. A surface is steady if its normal
   * speed at the sample points, from all terms, is within the tolerance, or, unless the tolerance
   * is 0, if the surface only oscillates (Displacement.h). No surface is steady after a substep
   * that created parts. The time of the surface advances. Throws like Advance;
   * std::invalid_argument if the tolerance is not >= 0.
   */
  AdvanceReport AdvanceToSteadyState(const Motion& motion, const SteadyStateCriterion& criterion,
    Target& target, const ProgressFunction& progress = {});

  ///@{
  /** Sums of the counts in the reports since the last start (of any kind) or ForgetWork, and the
   * largest MaxSpeed. Substeps before an exception in Advance are included. Clone copies this
   * report. */
  const AdvanceReport& GetWork() const;
  void ForgetWork();
  ///@}

  ///@{
  /** Area of the skin with the surfaces of voids [length^2], and volume without voids [length^3]:
   * now, and at the start. */
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

  /** The leaves of the potential with their masks, for skins and exporters. */
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
