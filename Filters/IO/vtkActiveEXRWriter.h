/**
 * @class   vtkActiveEXRWriter
 * @brief   writes an image, with all its point arrays, as an .exr file of many layers
 *
 * The input is an image of one slice (x * y * 1 points). The image's point arrays become channels
 * by the convention of layers in .exr files.
 *
 * @par Channels
 *   | Array of the image            | Channels of the file           |
 *   | ----------------------------- | ------------------------------ |
 *   | RGBA or RGB                   | R, G, B, A or R, G, B          |
 *   | scalars of integer colors     | R, G, B, A or R, G, B          |
 *   | other integer colors          | name.R, name.G, name.B, name.A |
 *   | N, P, others of 3 components  | N.X, N.Y, N.Z                  |
 *   | forward, others of 2          | forward.u, forward.v           |
 *   | others of 4                   | name.R, name.G, name.B, name.A |
 *   | others of more                | name.0, ... (00, beyond ten)   |
 *   | Z, id, others of 1            | its name as it is              |
 *
 * - Integer colors are arrays of unsigned char or unsigned short with 3 or 4 components, such as
 *   pictures from other readers and from windows, and all integer arrays RGB and RGBA.
 * - A dot in the name of an array of one component assigns the array to a layer.
 * - If the components of an array have names (SetComponentName), these names follow the dot, but
 *   not for the first two rows of the table. AddChannel replaces all these rules for an array.
 *
 * @par Values
 * - float and double arrays become FLOAT, integers UINT, integer colors HALF from 0 to 1.
 *   AssignPixelType chooses another type for an array.
 * - A value that does not fit (a number below 0 in UINT, 1e9 in HALF) is an error that reports the
 *   value. HALF and FLOAT accept NaN and infinity.
 * - Colors in EXR files are linear. The colors of a render window are encoded for a display: set
 *   ColorEncoding to SRGB for them.
 * - Rows are VTK's, from below: row 0 of the image is the lowest row of the picture.
 *   vtkActiveEXRReader returns the same values for float and unsigned int arrays, except for
 *   integer colors, and where AssignPixelType, ColorEncoding or DWAA changes values.
 *
 * @par Series
 * - FileName may contain a run of #, or \%d or \%04d, which FrameNumber replaces. FilePrefix and
 *   FilePattern are not used.
 * - With WriteAllTimeSteps there is a file for each of the input's time steps, numbered from
 *   FrameNumber on. Without a placeholder the number is put before the extension, name.0000.exr.
 * - The time of the input, if known [pipeline time], becomes the attribute "time".
 *
 * @par Threads
 * - The pixels are packed by as many threads as vtkSMPTools uses, unless the program has set
 *   another number for files of this format. The bytes do not depend on the number of threads.
 *
 * @par Errors
 * - A file is written whole or not at all: first under a temporary name in the same folder, then
 *   renamed.
 * - After a failure, ErrorCode returns the kind of error (vtkErrorCode), and an existing file is
 *   kept.
 */

#ifndef vtkActiveEXRWriter_h
#define vtkActiveEXRWriter_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkImageWriter.h"

#include <memory> // for the settings
#include <string> // for sentences

class vtkMatrix4x4;

class VTKACTIVEIO_EXPORT vtkActiveEXRWriter : public vtkImageWriter
{
public:
  static vtkActiveEXRWriter* New();
  vtkTypeMacro(vtkActiveEXRWriter, vtkImageWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Writes the file or, with WriteAllTimeSteps, the files. GetErrorCode() is 0 on success.
   */
  void Write() override;

  enum CompressionType
  {
    NONE = 0,
    ZIP = 1,
    ZIPS = 2,
    PIZ = 3,
    DWAA = 4
  };

  ///@{
  /**
   * Compression of pixels, lossless except for DWAA. NONE (0). ZIP (1): 16 rows at a time, widely
   * supported. ZIPS (2): row by row, for access to single rows. PIZ (3): wavelets, best for noise.
   * DWAA (4): small, with loss; an error if a channel is UINT or no color. Colors are R, G, B and
   * A, also of layers, and Y outside layers. Default: ZIP.
   */
  vtkSetClampMacro(Compression, int, NONE, DWAA);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(NONE); }
  void SetCompressionToZIP() { this->SetCompression(ZIP); }
  void SetCompressionToZIPS() { this->SetCompression(ZIPS); }
  void SetCompressionToPIZ() { this->SetCompression(PIZ); }
  void SetCompressionToDWAA() { this->SetCompression(DWAA); }
  ///@}

  ///@{
  /**
   * Effort of ZIP and ZIPS: 1 is fastest, 9 smallest. Range: 1 to 9. Default: 4.
   */
  vtkSetClampMacro(CompressionLevel, int, 1, 9);
  vtkGetMacro(CompressionLevel, int);
  ///@}

  enum ColorEncodingType
  {
    LINEAR = 0,
    SRGB = 1
  };

  ///@{
  /**
   * Encoding of the input's colors (arrays RGB and RGBA, and unsigned char or unsigned short arrays
   * of 3 or 4 components). LINEAR (0): linear light, not decoded. SRGB (1): encoded for a display;
   * all components but alpha are decoded to linear light, unless assigned UINT. Default: LINEAR.
   */
  vtkSetClampMacro(ColorEncoding, int, LINEAR, SRGB);
  vtkGetMacro(ColorEncoding, int);
  void SetColorEncodingToLinear() { this->SetColorEncoding(LINEAR); }
  void SetColorEncodingToSRGB() { this->SetColorEncoding(SRGB); }
  ///@}

  ///@{
  /**
   * Width and height of the display window [pixels], whose lower left pixel is point (0, 0) of the
   * input. The input's extent is the data window, which may exceed the display window. Values from
   * 1 to 2^24; 0, 0: the extent, moved to (0, 0), is both windows. Default: 0, 0.
   */
  vtkSetVector2Macro(DisplaySize, int);
  vtkGetVector2Macro(DisplaySize, int);
  ///@}

  ///@{
  /**
   * Width of a pixel, divided by its height [1]. Range: 1e-6 to 1e6. Default: 1.
   */
  vtkSetClampMacro(PixelAspectRatio, double, 1e-6, 1e6);
  vtkGetMacro(PixelAspectRatio, double);
  ///@}

  ///@{
  /**
   * Frame rate [1/second], the attribute framesPerSecond. Range: 0 to 1e6; 0: not written.
   * Default: 0.
   */
  vtkSetClampMacro(FramesPerSecond, double, 0.0, 1e6);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

  ///@{
  /**
   * Attribute timeCode, as "hours:minutes:seconds:frame", up to 23:59:59:29. Default: none.
   */
  vtkSetStringMacro(TimeCode);
  vtkGetStringMacro(TimeCode);
  ///@}

  ///@{
  /**
   * Matrix from world to camera coordinates (attribute worldToCamera: x to the right, y up, z
   * ahead). The matrix multiplies column vectors, as in VTK. The file contains the transposed
   * matrix in single precision. Default: none.
   */
  void SetWorldToCamera(vtkMatrix4x4* matrix);
  vtkMatrix4x4* GetWorldToCamera();
  ///@}

  ///@{
  /**
   * Matrix from world to picture coordinates (attribute worldToNDC). (0, 0) is the upper left
   * corner of the display window, (1, 1) the lower right. Convention and precision are those of
   * WorldToCamera. Default: none.
   */
  void SetWorldToNDC(vtkMatrix4x4* matrix);
  vtkMatrix4x4* GetWorldToNDC();
  ///@}

  ///@{
  /**
   * Adds or replaces an attribute of the header, a text or a number (written as double). Customary
   * texts: owner (author), comments, software (at first this package and its version), capDate
   * (date of capture, as "YYYY:MM:DD hh:mm:ss"). No time of day is written by default, so equal
   * input makes equal bytes. ClearAttributes() removes all added attributes, and software.
   */
  void AddAttribute(const char* name, const char* text);
  void AddAttribute(const char* name, double number);
  void ClearAttributes();
  ///@}

  ///@{
  /**
   * Writes a component of a point array as the channel named `channel`. Of this array, only the
   * channels added by AddChannel are then written; other arrays follow the table of Channels above.
   */
  void AddChannel(const char* array, int component, const char* channel);
  void ClearChannels();
  ///@}

  enum PixelType
  {
    UINT = 0,
    HALF = 1,
    FLOAT = 2
  };

  ///@{
  /**
   * Assigns a type to the channels of an array: UINT (0), HALF (1) or FLOAT (2), instead of the
   * type that follows from the array's type. HALF has a precision of 11 bits, enough for colors and
   * normals; depth and positions need FLOAT.
   */
  void AssignPixelType(const char* array, int type);
  void ClearPixelTypes();
  ///@}

  ///@{
  /**
   * Writes all time steps of the input, one file each. Default: off.
   */
  vtkSetMacro(WriteAllTimeSteps, bool);
  vtkGetMacro(WriteAllTimeSteps, bool);
  vtkBooleanMacro(WriteAllTimeSteps, bool);
  ///@}

  ///@{
  /**
   * Number that replaces a run of #, %d or %04d in FileName; with WriteAllTimeSteps, the number of
   * the first file. Range: 0 to 100000000. Default: 0.
   */
  vtkSetClampMacro(FrameNumber, int, 0, 100000000);
  vtkGetMacro(FrameNumber, int);
  ///@}

protected:
  vtkActiveEXRWriter();
  ~vtkActiveEXRWriter() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector*) override;

private:
  vtkActiveEXRWriter(const vtkActiveEXRWriter&) = delete;
  void operator=(const vtkActiveEXRWriter&) = delete;

  struct Settings;

  int CountSteps() const;
  void WriteStep(vtkImageData* image);
  void WriteImage(vtkImageData* image, const std::string& name);
  void Fail(unsigned long code, const std::string& sentence);

  int Compression = ZIP;
  int CompressionLevel = 4;
  int ColorEncoding = LINEAR;
  int DisplaySize[2] = { 0, 0 };
  double PixelAspectRatio = 1.0;
  double FramesPerSecond = 0.0;
  char* TimeCode = nullptr;
  bool WriteAllTimeSteps = false;
  int FrameNumber = 0;
  std::unique_ptr<Settings> Chosen;
};

#endif
