// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_ControllerPeers_h
#define vtkIsodiamond_ControllerPeers_h

#include "Field/Peers.h"

class vtkInformation;
class vtkMultiProcessController;

namespace vtkIsodiamond
{

/** The processes of ParaView's, or VTK's, global controller as peers. */
class ControllerPeers : public isodiamond::Peers
{
public:
  /** How many processes make an output together: each is asked for its own one of as many pieces as
   *  there are processes. Then all of them execute the filter, and may wait for each other.
   *  @return 1 if they do not */
  static int CountOf(vtkInformation* outputInformation);

  ControllerPeers();

  /** For exchanging arrays. */
  vtkMultiProcessController* Processes() const { return this->Controller; }

  int Count() const override;
  int Rank() const override;
  void Or(std::uint8_t* bytes, std::int64_t count) override;
  void Max(std::uint16_t* values, std::int64_t count) override;
  void Max(double* values, std::int64_t count) override;

private:
  vtkMultiProcessController* Controller;
};

}

#endif
