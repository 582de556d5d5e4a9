// Says when it has computed for about half a second. On a busy machine that takes as much
// longer as it does for Prolog in its worker.

const ROUNDS = 2e8;

function compute() {
  let sum = 0;
  for (let round = 0; round < ROUNDS; round += 1) sum = (Math.imul(sum, 31) + round) | 0;
  return sum;
}

postMessage(compute());
