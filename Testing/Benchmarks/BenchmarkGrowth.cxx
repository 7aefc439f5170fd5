// Growth of time and memory with the resolution, with the number of threads, and with the number of
// particles around the same surface.
//
// Run: BenchmarkGrowth [quick]
//
// Resolution: a ball of radius 0.6 in [-1,1]^3, n nodes along a side, the default scheme
// (attraction to a moving ball, tension). Prints seconds per substep, and the peak memory of a
// separate process during start and substeps, less the memory that remains after a run at n = 16.
// Exponents are slopes of a least-squares line through the logarithms. "while advancing" is the
// peak of the substeps only.
//
// Threads: half of the largest n, 1 to all threads, relative to one.
//
// Particles: a ball of radius 1 filled with 1,000 times 1, 4, 16 ... particles, whose kernels
// shrink with their spacing; the voxel size is constant. Prints seconds per frame of the filter,
// with the construction of the particles' search structure.

#include "Base/OpenVDB.h"
#include "Measuring.h"
#include "Scenes.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace activesurface;

namespace
{

/** Peak memory in kB since the process began or since ForgetPeak. */
double ReadPeak()
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.rfind("VmHWM:", 0) == 0)
    {
      return std::stod(line.substr(6));
    }
  }
  throw std::runtime_error("/proc/self/status has no VmHWM.");
}

void ForgetPeak()
{
  std::ofstream("/proc/self/clear_refs") << 5;
}

/** Measurements of a separate process for one n. */
struct Need
{
  double Voxels = 0.0;
  double Seconds = 0.0; //< per substep
  double Peak = 0.0;    //< bytes
  double Advancing = 0.0;
};

Motion MakeLaw()
{
  Motion motion = MakeMotion(10.0, 0.001);
  return motion;
}

Need MeasureNeed(int n, double before)
{
  Need need;
  WithThreads(1,
    [&]
    {
      NarrowBand band(VoxelSizeOf(n));
      band.SetNumberOfThreads(1);
      band.Start(0.0, Box, MakeInitial(BallDistance()));
      MovingBall target;
      const Motion motion = MakeLaw();
      need.Voxels = static_cast<double>(band.GetNumberOfActiveNodes());
      const double started = ReadPeak();
      ForgetPeak();
      const int substeps = std::max(8, 1280 / n);
      AdvanceSubsteps(band, substeps, motion, target);
      const double seconds = SecondsOf([&] { AdvanceSubsteps(band, substeps, motion, target); });
      need.Seconds = seconds / substeps;
      need.Advancing = 1024.0 * (ReadPeak() - before);
      need.Peak = std::max(need.Advancing, 1024.0 * (started - before));
    });
  return need;
}

/** Measures in a child process. Call before this process has started any thread. */
Need MeasureInChild(int n)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("No pipe.");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    // The first run loads code and allocates the threads' stacks, which do not count.
    MeasureNeed(16, 0.0);
    ForgetPeak();
    const Need need = MeasureNeed(n, ReadPeak());
    const bool written = write(ends[1], &need, sizeof need) == sizeof need;
    _exit(written ? 0 : 1);
  }
  Need need;
  const bool isRead = read(ends[0], &need, sizeof need) == sizeof need;
  int status = 0;
  waitpid(child, &status, 0);
  close(ends[0]);
  close(ends[1]);
  if (!isRead || status != 0)
  {
    throw std::runtime_error("The measuring process has failed.");
  }
  return need;
}

double FitExponent(const std::vector<double>& x, const std::vector<double>& y)
{
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const double count = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const double a = std::log(x[i]);
    const double b = std::log(y[i]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

/** One number per turn. */
template <class Number>
Costs Collect(const std::vector<std::vector<Need>>& turns, const Number& number)
{
  Costs costs;
  for (const std::vector<Need>& turn : turns)
  {
    costs.push_back(number(turn));
  }
  return costs;
}

void TellExponents(const std::vector<double>& sizes, const std::vector<std::vector<Need>>& turns)
{
  const auto fit = [&sizes](const std::vector<Need>& turn, double Need::*number)
  {
    std::vector<double> y;
    for (const Need& need : turn)
    {
      y.push_back(need.*number);
    }
    return FitExponent(sizes, y);
  };
  const std::string range = "n = 64 to " + std::to_string(std::lround(sizes.back()));
  const Work work = { "growth", range, 1 };
  Tell(work, "exponent of time", "",
    Collect(turns, [&](const std::vector<Need>& turn) { return fit(turn, &Need::Seconds); }));
  Tell(work, "exponent of memory", "",
    Collect(turns, [&](const std::vector<Need>& turn) { return fit(turn, &Need::Peak); }));
}

void GrowWithResolution(int largest, int repetitions)
{
  std::vector<double> sizes;
  for (int n = 64; n <= largest; n *= 2)
  {
    sizes.push_back(n);
  }
  std::vector<std::vector<Need>> turns(repetitions);
  for (std::vector<Need>& turn : turns)
  {
    for (const double n : sizes)
    {
      turn.push_back(MeasureInChild(static_cast<int>(n)));
    }
  }
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const std::string size = "n = " + std::to_string(std::lround(sizes[i]));
    const Work work = { "growth", size, 1 };
    using Turn = std::vector<Need>;
    Tell(work, "time of a substep", "s",
      Collect(turns, [i](const Turn& turn) { return turn[i].Seconds; }));
    Tell(work, "memory at the peak", "bytes per active voxel",
      Collect(turns, [i](const Turn& turn) { return turn[i].Peak / turn[i].Voxels; }));
    Tell(work, "memory while advancing", "bytes per active voxel",
      Collect(turns, [i](const Turn& turn) { return turn[i].Advancing / turn[i].Voxels; }));
  }
  TellExponents(sizes, turns);
}

double AdvanceWith(int threads, int n, NarrowBand& band, Target& target, const Motion& motion)
{
  band.SetNumberOfThreads(threads);
  const int substeps = std::max(8, 1280 / n);
  const auto work = [&] { AdvanceSubsteps(band, substeps, motion, target); };
  return SecondsOf(work) / substeps;
}

void GrowWithThreads(int n, int repetitions)
{
  NarrowBand band(VoxelSizeOf(n));
  band.Start(0.0, Box, MakeInitial(BallDistance()));
  MovingBall target;
  const Motion motion = MakeLaw();
  std::vector<Contestant> contestants;
  for (int threads = 1; threads <= CountThreads(); ++threads)
  {
    contestants.push_back({ std::to_string(threads) + " threads",
      [&, threads] { return AdvanceWith(threads, n, band, target, motion); } });
  }
  const std::vector<Costs> costs = MeasureInTurns(contestants, repetitions);
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    const Work work = { "growth", "n = " + std::to_string(n), static_cast<int>(i) + 1 };
    Tell(work, "time of a substep by the clock", "s", costs[i]);
    TellRatio(work, contestants[i].Name + " over 1", costs[0], costs[i]);
  }
}

/** Particles of a distorted lattice in a ball of radius 1 around (place, 0, 0). */
vtkSmartPointer<vtkPolyData> FillBall(double spacing, double place)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> off(-0.1 * spacing, 0.1 * spacing);
  vtkNew<vtkPoints> points;
  const int half = static_cast<int>(1.0 / spacing);
  for (int k = -half; k <= half; ++k)
  {
    for (int j = -half; j <= half; ++j)
    {
      for (int i = -half; i <= half; ++i)
      {
        const double length = spacing * std::sqrt(double(i * i + j * j + k * k));
        const double at[3] = { i * spacing + off(random), j * spacing + off(random),
          k * spacing + off(random) };
        if (length < 1.0)
        {
          points->InsertNextPoint(at[0] + place, at[1], at[2]);
        }
      }
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

/** Seconds for 0.1 of time towards a cloud that oscillates by half a voxel; frame 0 is the
 * start. */
double AdvanceFrame(double spacing, int frame, vtkActiveImplicitSurface* surface)
{
  const auto cloud = FillBall(spacing, 0.01 * (frame % 2));
  return SecondsOf(
    [&]
    {
      if (!surface->Advance(cloud, 0.1))
      {
        throw std::runtime_error("A frame was refused.");
      }
    });
}

void GrowWithParticles(double count, int frames)
{
  // A ball contains 4/3 pi / spacing^3 particles.
  const double spacing = std::cbrt(4.18879 / count);
  vtkNew<vtkActiveImplicitSurface> surface;
  surface->SetNumberOfThreads(1);
  surface->SetVoxelSize(0.02);
  surface->SetKernelRadius(2.0 * spacing);
  surface->SetAttraction(20.0);
  const double bounds[6] = { -1.4, 1.4, -1.4, 1.4, -1.4, 1.4 };
  surface->SetModelBounds(bounds);
  Costs costs;
  WithThreads(1,
    [&]
    {
      for (int frame = 0; frame <= frames; ++frame)
      {
        const double seconds = AdvanceFrame(spacing, frame, surface);
        if (frame > 0)
        {
          costs.push_back(seconds);
        }
      }
    });
  std::ostringstream name;
  name << std::lround(count / 1000.0) << "k particles";
  Tell({ "growth", name.str(), 1 }, "time of a frame", "s", costs);
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const bool isQuick = IsQuick(argc, argv);
  GrowWithResolution(isQuick ? 256 : 512, isQuick ? 3 : 5); // before any thread starts
  GrowWithThreads(isQuick ? 128 : 256, isQuick ? 7 : 15);
  for (double count = 1000.0; count <= (isQuick ? 16e3 : 256e3); count *= 4.0)
  {
    GrowWithParticles(count, isQuick ? 3 : 5);
  }
}
