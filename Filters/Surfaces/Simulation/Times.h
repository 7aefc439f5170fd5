// The two clocks of a surface, as types that cannot be mixed up, and the time that was asked for.

#ifndef Times_h
#define Times_h

namespace activesurface
{

// What the pipeline's TIME_STEPS and requests count in.
struct PipelineTime
{
  double Value = 0.0;

  bool operator==(PipelineTime other) const { return this->Value == other.Value; }
  bool operator!=(PipelineTime other) const { return this->Value != other.Value; }
};

// The time of the equation of motion, in the units of Attraction and Tension: 0 at the first step.
struct MotionTime
{
  double Value = 0.0;
};

struct RequestedTime
{
  int Step = 0; // the last one that is not after the time
  PipelineTime Time;
  bool Between = false; // after that step, before the next one
};

}

#endif
