// Computes for some hundredths of a second when it is asked. On a busy machine that takes as much
// longer as it does for Prolog in its worker.

const ROUNDS = 2e7;

onmessage = ({ data }) => {
  let sum = 0;
  for (let round = 0; round < ROUNDS; round += 1) sum = (Math.imul(sum, 31) + round) | 0;
  // Without the sum nothing would be computed.
  postMessage(sum === 0.5 ? sum : data);
};
