// Names that users and their programs have given. Pure.

const PLAIN = /^[\x20-\x7e]*$/;
/** Letters that are not drawn, or that turn the writing. */
const HIDDEN = /[\p{Cc}\p{Cf}\p{Co}\p{Cn}\p{Zl}\p{Zp}\p{Default_Ignorable_Code_Point}\u2800]/gu;
/** Between Arabic letters and in emoji, such letters change what is drawn. */
const JOINERS =
  /(?<=\p{Script=Arabic})\u200c(?=\p{Script=Arabic})|(?<=[\p{Extended_Pictographic}\ufe0f])\u200d(?=\p{Extended_Pictographic})|(?<=\p{Emoji})\ufe0f/gu;
const [FIRST_STRONG_ISOLATE, POP_ISOLATE] = ['\u2068', '\u2069'];

/** A name as part of any text: what is hidden in it is shown as �, and it turns no letter beside it. */
export function shownName(name: string): string {
  if (PLAIN.test(name)) return name;
  const joiners = new Set([...name.matchAll(JOINERS)].map(({ index }) => index));
  const shown = name.replace(HIDDEN, (letter, at: number) => (joiners.has(at) ? letter : '\ufffd'));
  return FIRST_STRONG_ISOLATE + shown + POP_ISOLATE;
}
