// Creates the target and the initial shape of a surface: from the functions of the settings, or
// from the frames of the inputs.

#ifndef TargetBuilder_h
#define TargetBuilder_h

#include "Frames/ParticleFrame.h"
#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"
#include "Targets/Warnings.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

// Values of the properties that may be automatic, in world units; time is pipeline time times
// TimeScale. 0: unused or unknown.
struct ValuesInUse
{
  double VoxelSize = 0.0;
  double ParticleSpacing = 0.0;
  double KernelRadius = 0.0; // of elements without a radius of their own
  double TargetReach = 0.0;
  double Attraction = 0.0;
  double Tension = 0.0;
  double TargetNoise = 0.0;
};

class TargetBuilder
{
public:
  // Keeps references to the arguments.
  TargetBuilder(const SurfaceSettings& settings, Warnings& warnings);
  TargetBuilder(const TargetBuilder&) = delete;
  void operator=(const TargetBuilder&) = delete;

  // Deletes what depends on the settings and the inputs.
  void Clear();

  // Limits the distance grids of meshes added later to ten times this number of voxels.
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumActiveVoxels = maximum; }

  // Adds the frame of a step; the last two frames are stored. Throws, and does not store the frame,
  // if the frame is of another kind than earlier frames or cannot be used.
  void Add(int step, std::shared_ptr<InputShape> shape);
  bool Has(int step) const { return this->Frames.Has(step); }

  // Replaces the frame of a step by this rank's part of the frame; SetPair replaces two consecutive
  // frames by their parts. areShuffled: see ParticleMatches.
  void SetPart(int step, const std::shared_ptr<InputShape>& shape);
  void SetPair(int step, const std::shared_ptr<InputShape>& earlier,
    const std::shared_ptr<InputShape>& later, bool areShuffled);
  // Returns the width around a rank's leaves, along each axis, in which the rank needs particles
  // [voxels].
  int FindMarginOfRanks();

  const TargetFrames& GetFrames() const { return this->Frames; }

  // Returns true if the stored frame of a step was made of the same data as `shape`.
  bool IsUnchanged(int step, const InputShape& shape) const
  {
    return this->Frames.Find(step)->Content == shape.Content;
  }

  // Returns true if one of the stored frames from `first` to `last` has particles; for a static
  // target, if its only frame has particles. Frames after `last` are ignored, because these may be
  // unknown yet.
  bool HasParticles(int first, int last) const
  {
    return this->FindKind(first, last)->GetParticles() != nullptr;
  }
  // Returns true if the settings allow the node scheme and these stored frames have particles, or
  // labels (FindLabelPixel > 0).
  bool IsOnNodes(int first, int last) const;
  // Returns true if the last frame with points is an image that was smoothed as a label.
  bool MayHaveLabels() const { return this->Kind->GetLabel() != nullptr; }
  // Returns the shortest side of the labels' pixels in these frames [length]; 0 without labels, or
  // if a frame with points is no label.
  double FindLabelPixel(int first, int last) const;
  // Returns the labels' volume [length^3] at a fraction of the interval from a step to the next
  // one; 0 without labels.
  double FindLabelVolume(int step, double fraction) const;
  // Returns true if the input has particles, or has had no points yet.
  bool MayHaveParticles() const
  {
    return this->Settings.UsesInput() && (!this->Kind->HasPoints() || this->Kind->GetParticles());
  }
  // Returns true if MayHaveParticles, and the velocity of particles carries the surface.
  bool MayCarry() const { return this->MayHaveParticles() && this->GetOptions().Carries; }

  // Returns the spacing of the particles [length], given or estimated; 0: unknown.
  double FindSpacing() const;
  // motion: parameters by which the skin moved.
  ValuesInUse FindValuesInUse(const Motion& motion) const;

  // Returns the periodic box of particles, relative to the origin of the shapes.
  PeriodicBox GetBox() const;
  // Returns the distance [length] beyond the sides of the periodic box within which the particles
  // of a step are repeated; without particles, the distance follows from the spacing.
  double FindMargin(int step) const;

  // Sets a missing estimate of the spacing to that of a loaded state, whose first frames may not be
  // read again.
  void KeepEstimatedSpacing(double spacing)
  {
    this->EstimatedSpacing = this->EstimatedSpacing > 0.0 ? this->EstimatedSpacing : spacing;
  }
  // Sets the domain, and a missing estimate of the spacing, to those of a loaded state. Call this
  // if the first frame is unavailable.
  void SetDomain(const SurfaceDomain& domain, double spacing);

  // Number and spacing of the particles of a frame.
  struct SpacingSample
  {
    std::size_t Particles = 0;
    double Spacing = 0.0; // 0: unknown
    bool HasRadii = false;
  };
  // Returns true if SettleSpacing is needed before the first frame is added.
  bool WantsSpacing() const;
  // Returns the steps to sample in addition to the first one.
  std::vector<int> ListSpacingSteps() const;
  static SpacingSample SampleSpacing(const InputShape& shape, const PeriodicBox& box);
  // Sets the spacing to the smallest spacing of the frames that have at least a tenth of the
  // largest number of particles. If the first sample's spacing differs from the smallest spacing by
  // at most 1 %, uses the first sample's spacing.
  void SettleSpacing(const std::vector<SpacingSample>& samples);

  // Returns a box that contains the inside of the target at a stored step; for a function or an
  // inverted target, the bounds of the domain. Without a target the box is invalid.
  vtkBoundingBox FindBoundsOfInside(int step) const;

  // Sets the initial shape from the input of port 1. Throws std::invalid_argument for an unusable
  // shape.
  void SetInitial(std::shared_ptr<InputShape> shape);
  bool WantsInitial() const { return this->Settings.Inputs.HasInitialInput && !this->Initial; }

  // Returns null while the bounds are unknown. ModelBounds are always known. Other bounds are
  // unknown before the first frames are added and, without an initial shape that has bounds, for
  // functions without bounds, and for an empty first frame unless HasOwnSizes() or a spacing gives
  // the sizes. Throws std::invalid_argument for invalid settings.
  const SurfaceDomain* FindDomain();
  // Returns the domain that FindDomain or SetDomain has set; null before.
  const SurfaceDomain* GetDomain() const { return this->DomainKnown ? &this->Domain : nullptr; }
  // Origin of the positions of all shapes, see SurfaceDomain.
  const std::array<double, 3>& GetOrigin() const { return this->Domain.Origin; }

  // Returns true if the target is an input, its first frame is missing or empty, and there is no
  // other initial shape.
  bool StartsOnNothing() const;

  // Makes a new target, at the frame of a step. FindDomain must have returned a domain.
  void StartTarget(int step = 0);
  // Prepares the target for evaluation at points.
  void CompleteTarget();

  // Returns the target, made if necessary. UseFramesFrom may replace the target; Clear and
  // ForgetTarget delete the target.
  PotentialTarget& GetTarget();
  // Selects the kind of the target: that of the frames of a step and the next one.
  void UseFramesFrom(int step);
  // Incremented whenever a target is made.
  std::size_t GetTargetNumber() const { return this->TargetNumber; }
  // Deletes the target. The next GetTarget makes one with the settings at that time.
  void ForgetTarget()
  {
    this->Moving = nullptr;
    this->Target.reset();
  }
  // Returns the target if it is made of frames of the input, otherwise null.
  MovingTarget* GetMovingTarget();

  // Returns a separate target with the options of GetTarget(). The separate target moves from a
  // stored step to the next one between two motion times. Add and Clear invalidate the separate
  // target, because it uses the stored frames. hasPoints: the target can be evaluated at points, at
  // the beginning of the interval.
  std::unique_ptr<PotentialTarget> MakeTargetAt(
    int step, double begin, double end, bool hasPoints = true) const;

  // Returns the initial shape; null: the surface starts on the target. Requires a domain.
  std::unique_ptr<PotentialTarget> MakeStart();

private:
  using KindPointer = std::shared_ptr<const InputShape>;

  void CheckKind(int step, const InputShape& shape) const;
  KindPointer FindKind(int first, int last) const;
  std::string DescribeStep(int step) const;
  TargetOptions GetOptions() const;
  std::string PrepareShape(
    InputShape& shape, const TargetOptions& options, const std::string& where) const;
  void EstimateSpacing(const InputShape& shape);
  void ReportSpacing(bool haveRadii) const;
  void Prepare(int step, InputShape& shape);
  void Report(
    const std::string& reason, const std::string& sentence); // if the sentence is not empty
  void WarnOfThinParts(const InputShape& shape, const std::string& where);
  void WarnOfLargeRadii(const InputShape& shape);
  void WarnOfUnusedBox(bool isUsed) const;
  void PrepareInitial();
  double GetSpacing() const;
  double GetPixel() const; // of the finest first image [length]; 0: no image
  double GetNoiseAtNodes() const;
  // Makes positions of the stored shapes relative to the domain's origin.
  void MoveToOrigin();
  bool AddFirstBounds(vtkBoundingBox& shapes, vtkBoundingBox& images) const;
  std::unique_ptr<PotentialTarget> MakeFunctionTarget() const;
  void MakeTarget();

  const SurfaceSettings& Settings;
  Warnings& Messages;
  std::size_t MaximumActiveVoxels = 50000000;

  TargetFrames Frames;
  KindPointer Kind; // the last frame with points; all frames have its kind
  double EstimatedSpacing = 0.0;
  bool ThinPartsKnown = false; // checked and reported
  bool OverlapKnown = false;   // checked and reported
  std::shared_ptr<InputShape> Initial;
  bool DomainKnown = false;
  SurfaceDomain Domain;

  std::unique_ptr<PotentialTarget> Target; // null until it is needed
  KindPointer KindOfTarget;
  MovingTarget* Moving = nullptr; // Target, if made of frames of the input
  std::size_t TargetNumber = 0;   // number of targets made
};

}

#endif
