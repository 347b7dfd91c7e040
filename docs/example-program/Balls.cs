// A collision library in C# as a subject of Nearmiss, over pipes in binary; docs/reference/protocol.md explains each line.
//
//     mcs -out:balls.exe docs/example-program/Balls.cs   &&   ./nearmiss run --command "mono balls.exe" --subject balls-cs
using System;
using System.IO;
using System.Text;

static class Balls {
  const string Hello =
      "{\"nearmiss\": 3, \"name\": \"balls-cs\", \"version\": \"1.0\", \"scalar\": \"double\", \"batches\": \"binary\", " +
      "\"offers\": [{\"query\": \"sphere_sphere_overlap\"}, " +
      "{\"query\": \"moving_point_sphere\", \"gives\": [\"time\", \"location\"]}]}\n";

  struct Answer {
    public bool Yes;
    public double[] Values;
    public string Cannot;
  }

  struct Offer {
    public Func<double[], Answer> Answer;
    public int Outputs;
    public ulong Given;  // a bit for each value
  }

  static readonly Offer[] Offers = {
    new Offer { Answer = BallsMeet, Outputs = 0, Given = 0 },
    new Offer { Answer = RayMeetsBall, Outputs = 7, Given = 15 },
  };

  static double[] Minus(double[] q, int i, int j) {
    return new[] { q[i] - q[j], q[i + 1] - q[j + 1], q[i + 2] - q[j + 2] };
  }
  static double Dot(double[] a, double[] b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  static Answer BallsMeet(double[] q) {
    double[] d = Minus(q, 0, 4);
    double reach = q[3] + q[7];
    return new Answer { Yes = Dot(d, d) <= reach * reach };
  }

  // The outputs are time, location and normal; the hello says that the normal is not given.
  static Answer RayMeetsBall(double[] q) {
    double[] v = { q[3], q[4], q[5] }, w = Minus(q, 0, 6);
    double a = Dot(v, v), b = Dot(w, v), c = Dot(w, w) - q[9] * q[9];
    if (c < 0 || a == 0) return new Answer { Cannot = "it starts inside, or does not move" };
    if (b >= 0 || b * b < a * c) return new Answer();
    double t = c / (Math.Sqrt(b * b - a * c) - b);
    return new Answer { Yes = true, Values = new[] { t, q[0] + v[0] * t, q[1] + v[1] * t, q[2] + v[2] * t, 0, 0, 0 } };
  }

  static void Write(BinaryWriter to, Answer a, uint number, Offer offer) {
    byte[] why = Encoding.UTF8.GetBytes(a.Cannot ?? "");
    to.Write((byte)(a.Cannot == null ? 0 : 1));
    to.Write((byte)(a.Yes ? 1 : 0));
    to.Write((ushort)why.Length);
    to.Write(number);
    to.Write(offer.Given);
    if (a.Cannot == null) foreach (double x in a.Values ?? new double[offer.Outputs]) to.Write(x);
    to.Write(why);
  }

  // False at the end of the cases.
  static bool AnswerBatch(BinaryReader cases, BinaryWriter answers) {
    byte[] head = cases.ReadBytes(16);
    if (head.Length < 16) return false;
    Offer offer = Offers[BitConverter.ToUInt32(head, 0)];
    uint count = BitConverter.ToUInt32(head, 4), first = BitConverter.ToUInt32(head, 8);
    uint[] lengths = new uint[count];
    for (int i = 0; i < count; ++i) lengths[i] = cases.ReadUInt32();
    for (uint i = 0; i < count; ++i) {
      double[] q = new double[lengths[i]];
      for (int k = 0; k < q.Length; ++k) q[k] = cases.ReadDouble();
      Write(answers, offer.Answer(q), first + i, offer);
    }
    answers.Flush();
    return true;
  }

  static Stream Pipe(string file, FileAccess access) {
    return new BufferedStream(new FileStream(file, FileMode.Open, access), 1 << 16);
  }

  static void Main() {
    BinaryReader cases = new BinaryReader(Pipe("/dev/fd/3", FileAccess.Read));
    BinaryWriter answers = new BinaryWriter(Pipe("/dev/fd/4", FileAccess.Write));
    answers.Write(Encoding.UTF8.GetBytes(Hello));
    answers.Flush();
    while (AnswerBatch(cases, answers)) {}
  }
}
