#define LOOP_SPACE plain
#include "harness/strands/baselines/serial_loop.inl"

namespace pelage::strands {

const SerialLoop plain_chain_loop = plain::advance;

}  // namespace pelage::strands
