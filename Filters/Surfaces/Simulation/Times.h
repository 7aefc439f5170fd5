// The two clocks of a surface, as separate types, and a requested time.

#ifndef Times_h
#define Times_h

namespace activesurface
{

// Time of the pipeline's TIME_STEPS and requests.
struct PipelineTime
{
  double Value = 0.0;

  bool operator==(PipelineTime other) const { return this->Value == other.Value; }
  bool operator!=(PipelineTime other) const { return this->Value != other.Value; }
};

// Time of the equation of motion: TimeScale * (pipeline time - that of the first step).
struct MotionTime
{
  double Value = 0.0;
};

struct RequestedTime
{
  int Step = 0; // last step <= Time
  PipelineTime Time;
  bool Between = false; // Time lies between this step and the next one
};

}

#endif
