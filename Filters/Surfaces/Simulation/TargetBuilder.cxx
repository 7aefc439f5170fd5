#include "Simulation/TargetBuilder.h"

#include "Targets/ImplicitTarget.h"
#include "Targets/LabelTarget.h"
#include "Targets/NoShape.h"
#include "Targets/ParticleShape.h"
#include "Targets/ParticleTarget.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

// A mesh as initial shape is sampled within this distance from its surface [voxels]. The band and
// its ghosts are within 6 voxels of the surface.
constexpr double InitialReach = 8.0;

// Largest number of voxels of a mesh's distance grid / largest number of active voxels of the skin.
// The band of the distance grid is wider than the skin's band, and has fewer bytes per voxel.
constexpr double MeshVoxelsPerActive = 10.0;

// Automatic TargetNoise, as a fraction of the spacing.
constexpr double NoiseOfSpacing = 0.25;

}

TargetBuilder::TargetBuilder(const SurfaceSettings& settings, Warnings& warnings)
  : Settings(settings)
  , Messages(warnings)
  , Kind(std::make_shared<NoShape>())
  , KindOfTarget(this->Kind)
{
}

void TargetBuilder::Clear()
{
  this->ForgetTarget();
  this->Frames.Clear();
  this->Kind = std::make_shared<NoShape>();
  this->EstimatedSpacing = 0.0;
  this->ThinPartsKnown = this->OverlapKnown = false;
  this->Initial.reset();
  this->DomainKnown = false;
  this->Domain = SurfaceDomain();
}

void TargetBuilder::Add(int step, std::shared_ptr<InputShape> shape)
{
  if (this->Kind->IsEmptyAs(*shape))
  {
    shape = std::make_shared<NoShape>();
  }
  this->CheckKind(step, *shape);
  shape->MoveTo(this->GetOrigin());
  this->Prepare(step, *shape);
  this->Kind = shape->HasPoints() ? shape : this->Kind;
  this->Frames.Add(step, std::move(shape), this->GetBox());
  this->Report("shuffled particles", this->Frames.DescribeMatches());
}

void TargetBuilder::SetPart(int step, const std::shared_ptr<InputShape>& shape)
{
  shape->MoveTo(this->GetOrigin());
  this->Prepare(step, *shape);
  this->Frames.Add(step, shape);
}

void TargetBuilder::SetPair(int step, const std::shared_ptr<InputShape>& earlier,
  const std::shared_ptr<InputShape>& later, bool areShuffled)
{
  this->Frames.SetPair(step, earlier, later,
    PairParticles(*earlier->GetParticles(), *later->GetParticles(), areShuffled));
  this->Report("shuffled particles", this->Frames.DescribeMatches());
}

// Adds a node to the margin of the node scheme, because positions between two steps are rounded.
int TargetBuilder::FindMarginOfRanks()
{
  const double reach = this->GetOptions().GetRadius(this->Settings.Particles.Model);
  return 1 +
    FindMarginOfNodes(
      ParticleTarget::GetNodeOptions(this->GetOptions(), this->Domain.VoxelSize), reach);
}

void TargetBuilder::Report(const std::string& reason, const std::string& sentence)
{
  if (!sentence.empty())
  {
    this->Messages.Say(reason, sentence);
  }
}

TargetBuilder::KindPointer TargetBuilder::FindKind(int first, int last) const
{
  static const KindPointer none = std::make_shared<NoShape>();
  const bool moves = this->Settings.Inputs.TargetMoves;
  for (int step = moves ? first : 0; step <= (moves ? last : 0); ++step)
  {
    if (const InputShape* shape = this->Frames.Find(step); shape && shape->HasPoints())
    {
      return this->Kind; // all frames have this kind
    }
  }
  return none;
}

void TargetBuilder::CheckKind(int step, const InputShape& shape) const
{
  if (shape.HasPoints() && this->Kind->HasPoints() && !this->Kind->IsOfKindOf(shape))
  {
    throw std::invalid_argument(std::string("The target is ") + shape.GetName() + " " +
      this->DescribeStep(step) + ", but " + this->Kind->GetName() +
      " before; all time steps of the input have to be of one kind.");
  }
}

std::string TargetBuilder::DescribeStep(int step) const
{
  std::ostringstream text;
  text << "at the time step " << this->Settings.Inputs.Steps.at(step);
  return text.str();
}

TargetOptions TargetBuilder::GetOptions() const
{
  const SurfaceSettings& settings = this->Settings;
  TargetOptions options;
  options.IsoValue = settings.IsoValue;
  options.Invert = settings.Invert;
  options.Normalize = settings.Normalize;
  options.Noise = std::max(settings.Noise, 0.0);
  options.NoiseAtNodes = this->GetNoiseAtNodes();
  options.Model = settings.Particles.Model;
  options.Spacing = this->FindSpacing();
  options.KernelRadius = std::max(settings.Particles.Radius, 0.0);
  options.Anisotropy = settings.Particles.Anisotropy;
  options.Threshold = settings.Particles.Threshold;
  options.Kernel = settings.Particles.Kernel;
  options.Box = this->GetBox();
  options.MeshThickness = settings.MeshThickness;
  options.MeshVoxels = MeshVoxelsPerActive * static_cast<double>(this->MaximumActiveVoxels);
  options.IsOnNodes = settings.UsesNodes();
  options.SmoothsLabels =
    settings.UsesNodes() && settings.Noise != 0.0 && !settings.StartsElsewhere();
  options.LabelNoise = settings.Noise;
  options.Carries = settings.UsesNodes() && settings.Inputs.TargetMoves;
  options.WeighsTension = settings.UsesNodes() && settings.Parameters.WeightedTension &&
    (settings.Tension > 0.0 || settings.HasAutomaticTension());
  options.OpensHollows = settings.Parameters.CreateParts && !settings.Parameters.Paper;
  options.IsDomainKnown = this->DomainKnown;
  if (this->DomainKnown)
  {
    options.Reach = this->Domain.Reach;
    options.VoxelSize = this->Domain.VoxelSize;
  }
  return options;
}

// Returns a message about defects, or an empty string. Throws if the shape is unusable. Returned
// messages, and those of std::runtime_error, begin with `where`.
std::string TargetBuilder::PrepareShape(
  InputShape& shape, const TargetOptions& options, const std::string& where) const
{
  try
  {
    const std::string flaw = shape.Prepare(options, this->Messages);
    return flaw.empty() ? "" : where + flaw;
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(where + error.what());
  }
}

void TargetBuilder::Prepare(int step, InputShape& shape)
{
  this->EstimateSpacing(shape);
  this->WarnOfLargeRadii(shape);
  TargetOptions options = this->GetOptions();
  options.When = this->DescribeStep(step);
  // At the level IsoValue, distances on both sides of the level are needed.
  options.MeshReach = options.Reach + std::fabs(this->Settings.IsoValue);
  options.MeshHint = " Here Reach is TargetReach plus the absolute value of TargetIsoValue, and "
                     "MaximumNumberOfVoxels is ten times MaximumNumberOfActiveVoxels.";
  const std::string where =
    std::string("The target, ") + shape.GetName() + ", " + options.When + ": ";
  this->Report("flaw of the target", this->PrepareShape(shape, options, where));
  this->WarnOfUnusedBox(!shape.HasPoints() || shape.GetParticles());
  this->WarnOfThinParts(shape, where);
}

// Checks only the first frame with points, because checking every frame would cost too much.
void TargetBuilder::WarnOfThinParts(const InputShape& shape, const std::string& where)
{
  if (this->ThinPartsKnown || !this->DomainKnown || !shape.HasPoints())
  {
    return;
  }
  this->ThinPartsKnown = true;
  const std::string thin = shape.DescribeThinParts(this->GetOptions());
  this->Report("thin parts", thin.empty() ? thin : where + thin);
}

void TargetBuilder::PrepareInitial()
{
  TargetOptions options = this->GetOptions();
  options.SmoothsLabels = false;
  options.When = "of input port 1";
  options.MeshReach = InitialReach * this->Domain.VoxelSize;
  options.MeshHint = " Here Reach is fixed; the maximum is ten times MaximumNumberOfActiveVoxels.";
  this->Report("flaw of the initial shape",
    this->PrepareShape(*this->Initial, options, "The input of port 1, Initial: "));
}

void TargetBuilder::SetInitial(std::shared_ptr<InputShape> shape)
{
  if (!shape->HasPoints())
  {
    throw std::invalid_argument("The input of port 1, Initial, is empty, so there is no initial "
                                "shape. Disconnect it, or connect a closed mesh or an image.");
  }
  if (!shape->CanStart())
  {
    throw std::invalid_argument(std::string("The input of port 1, Initial, is ") +
      shape->GetName() +
      ", which is no initial shape: connect a closed mesh of polygons or an image.");
  }
  shape->MoveTo(this->GetOrigin());
  this->Initial = std::move(shape);
}

// Returns the distance by which the surface of a body of particles flickers: TargetNoise or, if
// automatic, a fraction of the spacing. Returns 0 without the node scheme, and for an automatic
// TargetNoise over sums of kernels.
double TargetBuilder::GetNoiseAtNodes() const
{
  if (!this->Settings.UsesNodes())
  {
    return 0.0;
  }
  if (this->Settings.Noise != Automatic)
  {
    return this->Settings.Noise;
  }
  return this->Settings.SmoothsParticles() ? NoiseOfSpacing * this->FindSpacing() : 0.0;
}

ValuesInUse TargetBuilder::FindValuesInUse(const Motion& motion) const
{
  const ParticleSettings& particles = this->Settings.Particles;
  const ParticleModel model = this->MayHaveParticles() ? particles.Model : ParticleModel::Sum;
  ValuesInUse values;
  values.VoxelSize = this->DomainKnown ? this->Domain.VoxelSize : 0.0;
  values.TargetReach = this->DomainKnown ? this->Domain.Reach : 0.0;
  values.ParticleSpacing = this->FindSpacing();
  values.KernelRadius =
    particles.Radius > 0.0 ? particles.Radius : GetReachPerSpacing(model) * values.ParticleSpacing;
  values.Attraction = motion.Attraction;
  values.Tension = motion.Tension;
  const bool isOnNodes = this->Settings.UsesNodes() && this->MayHaveParticles();
  values.TargetNoise = isOnNodes ? this->GetNoiseAtNodes() : std::max(this->Settings.Noise, 0.0);
  const int step = this->Frames.FindLastStep();
  if (const double pixel = this->FindLabelPixel(step, step); pixel > 0.0)
  {
    values.TargetNoise = pixel * LabelTarget::FindFreedom(this->GetOptions(), pixel);
  }
  return values;
}

PeriodicBox TargetBuilder::GetBox() const
{
  const ParticleSettings& particles = this->Settings.Particles;
  PeriodicBox box;
  for (std::size_t axis = 0; axis < 3 && this->MayHaveParticles(); ++axis)
  {
    if (particles.IsPeriodic(axis))
    {
      box.Low[axis] = particles.Periodic[2 * axis] - this->GetOrigin()[axis];
      box.Length[axis] = particles.Periodic[2 * axis + 1] - particles.Periodic[2 * axis];
    }
  }
  return box;
}

double TargetBuilder::FindMargin(int step) const
{
  const double largest = this->Frames.GetParticles(step).Particles.GetLargestRadius();
  return PeriodicBox::GetMargin(largest > 0.0
      ? largest
      : GetReachPerSpacing(this->Settings.Particles.Model) * this->FindSpacing());
}

PotentialTarget& TargetBuilder::GetTarget()
{
  if (!this->Target)
  {
    this->MakeTarget();
  }
  return *this->Target;
}

MovingTarget* TargetBuilder::GetMovingTarget()
{
  this->GetTarget();
  return this->Moving;
}

void TargetBuilder::UseFramesFrom(int step)
{
  const KindPointer kind = this->FindKind(step, step + 1);
  if (!kind->IsOfKindOf(*this->KindOfTarget))
  {
    this->ForgetTarget();
  }
  this->KindOfTarget = kind;
}

std::unique_ptr<PotentialTarget> TargetBuilder::MakeFunctionTarget() const
{
  return std::make_unique<ImplicitTarget>(
    this->Settings.Inputs.TargetFunction, this->GetOptions(), this->GetOrigin());
}

void TargetBuilder::MakeTarget()
{
  ++this->TargetNumber;
  this->Moving = nullptr;
  if (!this->Settings.UsesInput())
  {
    this->WarnOfUnusedBox(false);
    this->Target = this->MakeFunctionTarget();
    return;
  }
  auto moving = this->KindOfTarget->MakeTarget(this->Frames, this->GetOptions());
  this->Moving = moving.get();
  this->Target = std::move(moving);
}

void TargetBuilder::StartTarget(int step)
{
  this->UseFramesFrom(step - 1);
  this->MakeTarget();
  if (this->Moving)
  {
    this->Prepare(step, *this->Frames.Find(step));
    this->Moving->MoveAlong(step, 0.0, 0.0);
  }
}

void TargetBuilder::CompleteTarget()
{
  if (this->Moving)
  {
    this->Moving->Complete();
  }
}

std::unique_ptr<PotentialTarget> TargetBuilder::MakeTargetAt(
  int step, double begin, double end, bool hasPoints) const
{
  if (!this->Settings.UsesInput())
  {
    return this->MakeFunctionTarget();
  }
  auto target = this->FindKind(step, step + 1)->MakeTarget(this->Frames, this->GetOptions());
  target->MoveAlong(step, begin, end);
  if (hasPoints)
  {
    target->Complete();
  }
  return target;
}

std::unique_ptr<PotentialTarget> TargetBuilder::MakeStart()
{
  vtkImplicitFunction* function = this->Settings.Inputs.InitialFunction;
  if (this->Initial)
  {
    this->PrepareInitial();
    function = this->Initial->GetFunction();
  }
  if (!function)
  {
    return nullptr;
  }
  TargetOptions options; // no level
  options.VoxelSize = this->Domain.VoxelSize;
  return std::make_unique<ImplicitTarget>(
    function, options, this->Initial ? std::array<double, 3>{} : this->GetOrigin());
}

}
