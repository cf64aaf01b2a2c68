// What a search finds is ordered by these scores: pages and the calls of r37 come before the inside.
var Scorer = {
  score: ([page, , , , score]) => (/^api\/r37(core|imports|studies)/.test(page) ? score - 1000 : score),
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
