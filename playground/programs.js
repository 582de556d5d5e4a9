// The user's programs by name, as the browser keeps them: a text that would be replaced is kept
// here before. At most MOST programs are kept; the oldest goes first.

const KEY = 'ev3dev playground programs';
const MOST = 60;

function read() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? [];
  } catch {
    return [];
  }
}

/** @returns {object[]} the newest first: each has name, text, world, task, and when it was kept */
export const programs = () => read();

/** Keeps a program under its name. If another one has it, which is not its `former` text, the name
    gets a number. Answers the name. */
export function keepProgram(program, former) {
  let all = read();
  const same = all.find(({ text }) => text === program.text);
  if (same) return same.name;
  const bare = program.name.replace(/\.pl$/, '');
  let { name } = program;
  for (let n = 2; all.some((each) => each.name === name && each.text !== former); n += 1) name = `${bare}_${n}.pl`;
  all = [{ ...program, name, kept: Date.now() }, ...all.filter((each) => each.name !== name)].slice(0, MOST);
  while (all.length) {
    try {
      localStorage.setItem(KEY, JSON.stringify(all));
      break;
    } catch {
      all.pop();
    }
  }
  return name;
}
