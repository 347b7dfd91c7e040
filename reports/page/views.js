"use strict";
/// The views of the page: the findings, the answers of all subjects, and the trades, each with its address.
nearmiss.views = (answers, trades, addressOfFindings, filterFindings) => {
  const {element} = nearmiss.numbers, mainOf = name => document.getElementById(name), price = mainOf("price");
  const tabs = [{button: null, view: null, main: mainOf("findings")}];
  let shown = tabs[0];

  function show(tab) {
    shown = tab;
    for (const name of ["findings", "subjects", "price"]) mainOf(name).hidden = mainOf(name) !== tab.main;
    if (tab.main === price) price.replaceChildren(...tab.view.elements);
    for (const t of tabs) if (t.button) t.button.setAttribute("aria-pressed", String(t === tab));
    history.replaceState(null, "", `#${tab.view ? tab.address : addressOfFindings()}`);
  }
  function add(tab, text) {
    tab.button = element("button", {type: "button", "aria-pressed": String(tab === shown), onclick: () => show(tab)}, text);
    document.getElementById("views").append(tab.button);
  }
  function addTrade({name, trade}) {
    const tab = {name, address: "", main: price};
    const choose = query => {
      tab.address = `price/${encodeURIComponent(name)}/${query}`;
      if (shown === tab) history.replaceState(null, "", `#${tab.address}`);
    };
    tab.view = nearmiss.tradeView(trade, choose);
    tab.view.elements[0].prepend(element("p", {class: "note"}, tab.view.description));
    tab.view.begin(null);
    tabs.push(tab);
    add(tab, `Price: ${name}`);
  }
  function addSubjects() {
    const tab = {name: null, address: "subjects", main: mainOf("subjects"), view: {step: () => {}}};
    tab.main.append(nearmiss.subjects(answers, (subject, query) => {
      show(tabs[0]);
      filterFindings(`subject=${subject} query=${query}`);
    }));
    tabs.push(tab);
    add(tab, "Subjects");
  }
  if (trades.length + answers.length > 0) {
    add(tabs[0], "Findings");
    if (answers.length > 0) addSubjects();
    trades.forEach(addTrade);
  }

  /// Shows the view of an address, "subjects" or "price/driving/ray_aabox"; does nothing for any other.
  function open(address) {
    const [kind, name, query] = address.split("/");
    const tab = tabs.find(t => t.view && (kind === "price" ? encodeURIComponent(t.name) === name : t.address === address));
    if (!tab) return;
    if (kind === "price") tab.view.begin(query);
    show(tab);
  }
  /// The view of the shown subjects or trade; null where the findings are shown.
  return {open, shown: () => shown.view};
};
