"use strict";
/// The stages of subjects that answer in stages: a bar of the calls that each stage answers, and one of the time that these calls take.
nearmiss.stages = ({short}) => {
  const {element, about, percent} = nearmiss.numbers;
  const meanings = {filter: "doubles with error bounds", extended: "double-words with error bounds", exact: "exact real numbers", plain: "inputs that are not finite"};

  function bar(name, stages, share) {
    const part = s => element("i", {class: `stage ${s.stage}`, style: `width:${100 * share(s)}%`, "data-share": String(share(s)),
      title: `${s.stage} (${meanings[s.stage]}): ${percent(share(s))} of the ${name}`});
    return element("div", {class: "bar-of-stages"}, element("span", {}, name), element("div", {}, stages.map(part)));
  }
  function figure(s) {
    const text = st => element("span", {class: "stage-text"}, element("i", {class: `stage ${st.stage}`}), `${st.stage}: ${percent(st.calls.share)} × ${about(st.mean)} ns`);
    return element("figure", {class: "stages", "data-subject": s.subject}, element("figcaption", {}, element("b", {}, short(s.subject)), s.stages.map(text)),
      bar("calls", s.stages, st => st.calls.share), bar("time", s.stages, st => st.share_of_time));
  }
  /// Empty where no subject answers in stages.
  function draw(query) {
    const subjects = query.subjects.filter(s => s.stages && s.stages.length > 0);
    if (subjects.length === 0) return [];
    return [element("h3", {}, "Stages"), ...subjects.map(figure),
      element("p", {class: "note"}, "Share of the timed calls that each stage answers, times the mean cost of such a call. Filter: doubles with error bounds; extended: double-words; exact: exact real numbers. A case goes on to the next stage where a comparison is in doubt or a number is not accurate enough.")];
  }
  return {draw};
};
